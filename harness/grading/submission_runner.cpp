#include "harness/grading/submission_runner.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "harness/cells/cells.h"
#include "harness/cells/host.h"
#include "harness/cells/others_busy.h"
#include "harness/submissions/submitted_image.h"
#include "scenes/base/input_error.h"
#include "scenes/base/json_text.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/file_checksum.h"
#include "scenes/files/scratch_folder.h"

namespace photonproof::inline harness_grading {
namespace {

namespace fs = std::filesystem;

// Adds the names and contents of a tree, in order.
void add_tree(const fs::path& tree, std::vector<std::pair<std::string, std::string>>& parts) {
  std::vector<std::pair<std::string, std::string>> files;
  for (const auto& entry : fs::recursive_directory_iterator(tree)) {
    const std::string name = entry.path().lexically_relative(tree).string();
    if (entry.is_symlink())
      files.emplace_back(name, fs::read_symlink(entry.path()).string());
    else if (entry.is_regular_file())
      files.emplace_back(name, file_checksum(entry.path()));
  }
  std::ranges::sort(files);
  parts.insert(parts.end(), files.begin(), files.end());
}

SandboxLimits sandbox_limits(const AssignmentLimits& limits) {
  SandboxLimits sandbox;
  sandbox.wall_seconds = limits.seconds;
  sandbox.memory_bytes = limits.memory_mb << 20;
  sandbox.file_bytes = limits.file_mb << 20;
  sandbox.disk_bytes = limits.disk_mb << 20;
  sandbox.log_bytes = limits.log_mb << 20;
  sandbox.processes = limits.processes;
  return sandbox;
}

const char* end_text(RunOutcome::Kind kind) {
  using Kind = RunOutcome::Kind;
  switch (kind) {
    case Kind::ok:
      return "ok";
    case Kind::not_started:
      return "not started";
    case Kind::crash:
      return "crash";
    case Kind::timeout:
      return "timeout";
    case Kind::memory:
      return "memory";
    case Kind::disk:
      return "disk";
    case Kind::log:
      return "log";
    case Kind::file_size:
      return "file size";
    case Kind::no_image:
      return "no image";
    case Kind::bad_image:
      return "bad image";
    case Kind::interrupted:
      break;
  }
  return "interrupted";
}

ImageDeclaration declaration_of(const AssignmentImage& image, int width, int height) {
  ImageDeclaration declaration;
  declaration.format = *submitted_format(image.format);
  using Kind = Transfer::Kind;
  if (!image.gamma)
    declaration.transfer = {Kind::srgb, 1};
  else if (*image.gamma != 1)
    declaration.transfer = {Kind::gamma, *image.gamma};
  declaration.bottom_up = image.bottom_up;
  declaration.scale = image.scale;
  declaration.width = width;
  declaration.height = height;
  return declaration;
}

// Whether any file of one tree differs in the other tree or is missing there.
bool any_file_differs(const fs::path& tree, const fs::path& other) {
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(tree)) {
    if (!entry.is_regular_file()) continue;
    const fs::path twin = other / entry.path().lexically_relative(tree);
    if (!fs::is_regular_file(fs::symlink_status(twin)) || read_file(entry.path()) != read_file(twin)) return true;
  }
  return false;
}

// Written beside built/ once that is complete.
constexpr const char* kept_build = "built.json";

void keep_build(const PreparedSubmission& submission) {
  const nlohmann::json json = {{"checksum", submission.checksum},
                               {"sentence", submission.sentence},
                               {"log", submission.log_tail},
                               {"seconds", submission.seconds}};
  write_file_atomically(submission.folder.parent_path() / kept_build, json_text(json));
}

// A damaged build is made again.
bool take_kept_build(PreparedSubmission& submission) {
  const fs::path file = submission.folder.parent_path() / kept_build;
  if (!fs::exists(file) || !fs::is_directory(submission.folder)) return false;
  try {
    const auto json = nlohmann::json::parse(read_file(file));
    if (json.at("checksum") != submission.checksum) return false;
    submission.sentence = json.at("sentence");
    submission.log_tail = json.at("log");
    submission.seconds = json.at("seconds");
  } catch (const nlohmann::json::exception&) {
    return false;
  }
  submission.built = true;
  return true;
}

}  // namespace

SubmissionRunner::SubmissionRunner(const Assignment& assignment, const SubmissionRunnerOptions& options)
    : assignment_(assignment), options_(options) {
  if (!options.contained) return;
  if (const auto why = why_no_sandbox())
    throw InputError("sandbox", *why + "; --no-sandbox runs submissions without one, at your risk");
  // Folders that every submission can read must not hold hidden scenes.
  if (is_part_of_system(assignment.folder))
    throw InputError(assignment.folder.string(),
                     "is part of the system, which submissions can read: put the assignment elsewhere");
}

std::string SubmissionRunner::containment() const {
  return options_.contained ? "bubblewrap: no network, no other process, read-only system"
                            : "none (--no-sandbox): limits alone";
}

BuildRecipe SubmissionRunner::recipe() const {
  BuildRecipe recipe;
  if (!assignment_.build_command.empty())
    recipe.command = with_values(assignment_.build_command, {{"threads", std::to_string(options_.threads)}});
  recipe.overwrite = assignment_.overwrite;
  recipe.limits = sandbox_limits(assignment_.build_limits);
  return recipe;
}

PreparedSubmission SubmissionRunner::take(const std::string& name, const fs::path& source,
                                          const fs::path& folder) const {
  PreparedSubmission taken;
  taken.name = name;
  taken.source = source;
  taken.folder = folder / "built";
  fs::remove_all(folder / "source");
  fs::create_directories(folder);
  try {
    take_in({name, source}, folder / "source", {}, handling());
  } catch (const SubmissionError& error) {
    taken.sentence = error.what();
    return taken;
  }
  const BuildRecipe build = recipe();
  std::vector<std::pair<std::string, std::string>> parts{{"build", length_prefixed(build.command)}};
  add_tree(folder / "source", parts);
  if (!build.overwrite.empty()) add_tree(build.overwrite, parts);
  taken.checksum = content_key(parts);
  return taken;
}

void SubmissionRunner::build(PreparedSubmission& submission, bool reuse) const {
  if (reuse && take_kept_build(submission)) return;
  const fs::path folder = submission.folder.parent_path();
  fs::remove(folder / kept_build);
  fs::remove_all(submission.folder);
  BuildRecipe build = recipe();
  const OthersBusy busy;
  BuildOutcome outcome = build_submission(folder / "source", build, submission.folder, handling());
  const double more_time = time_beside_others(busy, outcome.cpu_seconds, outcome.seconds);
  if (outcome.timed_out && more_time > 1) {
    build.limits.wall_seconds *= more_time;
    fs::remove_all(submission.folder);
    outcome = build_submission(folder / "source", build, submission.folder, handling());
  }
  submission.built = outcome.ok;
  submission.sentence = outcome.sentence;
  submission.log_tail = outcome.log_tail;
  submission.seconds = outcome.seconds;
  if (outcome.ok) keep_build(submission);
}

std::optional<PreparedSubmission> SubmissionRunner::built_as_handed_in(const PreparedSubmission& submission) const {
  const fs::path source = submission.folder.parent_path() / "source";
  if (assignment_.overwrite.empty() || !any_file_differs(assignment_.overwrite, source)) return std::nullopt;
  PreparedSubmission own = submission;
  own.folder = submission.folder.parent_path() / "as-handed-in";
  own.checksum = content_key({{"without staff's files", submission.checksum}});
  BuildRecipe build = recipe();
  build.overwrite.clear();
  fs::remove_all(own.folder);
  if (!build_submission(source, build, own.folder, handling()).ok) return std::nullopt;
  return own;
}

DrawnRun SubmissionRunner::run(const PreparedSubmission& submission, const SubmissionRunRequest& request) const {
  const ScratchFolder scratch("grade");
  RunRecipe recipe = request.recipe;
  recipe.scene_folder = request.scene.path;
  recipe.limits = sandbox_limits(assignment_.limits);
  recipe.limits.wall_seconds *= request.more_time;
  RunOutcome outcome =
      run_submission(submission.folder, recipe, declaration_of(assignment_.image, request.width, request.height),
                     scratch.path() / "image", options_.program, handling());
  DrawnRun drawn;
  drawn.run.end = end_text(outcome.kind);
  if (outcome.kind != RunOutcome::Kind::ok) drawn.run.sentence = outcome.sentence;
  drawn.run.wall_seconds = outcome.wall_seconds;
  drawn.run.cpu_seconds = outcome.cpu_seconds;
  drawn.run.peak_bytes = outcome.peak_bytes;
  drawn.run.log_tail = outcome.log_tail;
  drawn.image = std::move(outcome.image);
  return drawn;
}

Image SubmissionRunner::read_given(const fs::path& file, int width, int height) const {
  SubmittedImage read = read_submitted_image(file, file.string(), declaration_of(assignment_.image, width, height),
                                             options_.program, handling());
  if (!read.image) throw InputError(file.string(), read.wrong);
  return std::move(*read.image);
}

}  // namespace photonproof::inline harness_grading
