#include "harness/submissions/run_submission.h"

#include <cstdio>

#include "harness/submissions/submission_tree.h"
#include "harness/submissions/submitted_image.h"
#include "scenes/base/input_error.h"
#include "scenes/base/shell_text.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/scratch_folder.h"

namespace photonproof::inline harness_submissions {
namespace {

namespace fs = std::filesystem;
using Kind = RunOutcome::Kind;

fs::path checked_place(const std::string& text) {
  const fs::path place = fs::path(text).lexically_normal();
  if (place.is_absolute() || !place.has_filename() || *place.begin() == ".." || place == ".")
    throw InputError(text, "is no place for a file within the run's folder");
  return place;
}

Kind kind_of_end(const SandboxOutcome& outcome) {
  using End = ProcessOutcome::End;
  if (outcome.process.end == End::interrupted) return Kind::interrupted;
  if (outcome.limit == "time" || outcome.limit == "processor time") return Kind::timeout;
  if (outcome.limit == "memory") return Kind::memory;
  if (outcome.limit == "disk") return Kind::disk;
  if (outcome.limit == "log") return Kind::log;
  if (outcome.limit == "file size") return Kind::file_size;
  return outcome.process.end == End::not_started ? Kind::not_started : Kind::crash;
}

std::string what_is_wrong_with_kind(const std::string& kind) {
  if (kind.empty()) return " was not written";
  if (kind == "symbolic link") return " is a symbolic link, not a file";
  return " is a " + kind + ", not a file";
}

constexpr const char* scene_inside = "/scene";

// Removes the image of the first run before the second starts, whatever the first run did.
std::vector<std::string> one_after_the_other(const RunRecipe& recipe, const std::map<std::string, std::string>& values,
                                             const std::vector<std::string>& second, const std::string& output) {
  const std::string image = shell_word(output);
  const std::string move = recipe.leaves_image_before ? "mv -f " + image + " \"$TMPDIR\"" : "rm -f " + image;
  return {"sh", "-c",
          "{ " + shell_line(with_values(recipe.command_before, values)) + "; " + move + "; } >/dev/null 2>&1; exec " +
              shell_line(second)};
}

// Fills the command's own folder before the command starts.
void make_run_folder(const fs::path& built, const fs::path& tree_inside, const RunRecipe& recipe,
                     const std::string& output, const fs::path& folder) {
  const fs::path params = recipe.params_place.empty() ? fs::path() : checked_place(recipe.params_place);
  link_farm(built, tree_inside, params, folder);
  if (!params.empty()) write_file_atomically(folder / params, recipe.params);
  fs::remove(folder / output);  // a submitted image is no output
}

}  // namespace

RunOutcome run_submission(const fs::path& built, const RunRecipe& recipe, const ImageDeclaration& declaration,
                          const fs::path& output_file, const fs::path& program, const Handling& handling) {
  const std::string output = std::string("output.") + name_of(declaration.format);
  const fs::path tree = fs::canonical(built);
  const ScratchFolder scratch("run");
  const fs::path start = scratch.path() / "start";
  make_run_folder(tree, handling.contained ? fs::path(submission_inside) : tree, recipe, output, start);
  std::map<std::string, std::string> values = recipe.values;
  values["output"] = output;
  if (!recipe.params_place.empty()) values["params"] = recipe.params_place;
  SandboxOptions options;
  options.mounts = {{tree, submission_inside}};
  if (!recipe.scene_folder.empty()) {
    const fs::path scene = fs::canonical(recipe.scene_folder);
    options.mounts.push_back({scene, scene_inside});
    values["scene"] = ((handling.contained ? fs::path(scene_inside) : scene) / scene_file_name).string();
  }
  options.starts_with = start;
  options.collect = output;
  options.collect_to = fs::absolute(output_file);
  options.environment = recipe.environment;
  options.limits = recipe.limits;
  options.interrupt = handling.interrupt;
  options.contained = handling.contained;
  fs::remove(output_file);
  std::vector<std::string> argv = with_values(recipe.command, values);
  if (!recipe.command_before.empty()) {
    argv = one_after_the_other(recipe, values, argv, output);
    options.limits.wall_seconds *= 2;
    options.limits.cpu_seconds *= 2;
  }
  const SandboxOutcome outcome = run_sandboxed(argv, options);
  RunOutcome run;
  run.wall_seconds = outcome.process.wall_seconds;
  run.cpu_seconds = outcome.process.all_cpu_seconds;  // bubblewrap does not wait for the command
  run.peak_bytes = outcome.process.peak_bytes;
  run.log_tail = log_tail(outcome.process);
  run.sentence = outcome_sentence("the program", outcome);
  if (!outcome.ok()) {
    run.kind = kind_of_end(outcome);
    return run;
  }
  if (!outcome.collected) {
    run.kind = Kind::no_image;
    run.sentence = output + what_is_wrong_with_kind(outcome.collected_kind);
    return run;
  }
  SubmittedImage read = read_submitted_image(output_file, output, declaration, program, handling);
  run.kind = read.image ? Kind::ok : Kind::bad_image;
  char took[64];
  std::snprintf(took, sizeof took, "ran in %.2f s", run.wall_seconds);
  run.sentence = read.image ? took : read.wrong;
  run.image = std::move(read.image);
  return run;
}

}  // namespace photonproof::inline harness_submissions
