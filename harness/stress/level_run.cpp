#include "harness/stress/level_run.h"

#include <algorithm>
#include <utility>

#include "harness/cells/cells.h"
#include "harness/images/executor.h"
#include "harness/suites/engine_command.h"
#include "harness/suites/engine_stats.h"
#include "harness/variants/own_engine.h"
#include "scenes/base/input_error.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/file_checksum.h"
#include "scenes/files/scratch_folder.h"
#include "scenes/xml/writer.h"

namespace photonproof::inline harness_stress {
namespace {

namespace fs = std::filesystem;

/// The time limit of a render in seconds; a longer one counts as hanging. (bdpt takes 170 s for a closed room of albedo
/// 0.9999 on an idle machine.)
constexpr double render_limit = 600;

std::string scene_text(const StressScene& scene) {
  std::string text = write_scene(scene.scene);
  if (scene.replaced.empty()) return text;
  const std::size_t at = text.find(scene.replaced);
  if (at == std::string::npos) throw std::logic_error("a scene has no " + scene.replaced);
  return text.replace(at, scene.replaced.size(), scene.replacement);
}

/// Shortens the program's messages to the scene's file name: its folder is temporary.
void leave_out(const fs::path& folder, std::string& text) {
  const std::string path = folder.string() + "/";
  for (std::size_t at = 0; (at = text.find(path)) != std::string::npos;) text.erase(at, path.size());
}

}  // namespace

StressRunner::StressRunner(fs::path program, fs::path folder, std::vector<Engine> others,
                           const std::atomic<bool>* interrupt)
    : program_(std::move(program)),
      folder_(std::move(folder)),
      others_(std::move(others)),
      interrupt_(interrupt),
      checksum_(file_checksum(program_)) {}

const Engine* StressRunner::other(const std::string& engine) const {
  const auto row = std::find_if(others_.begin(), others_.end(), [&](const Engine& e) { return e.name == engine; });
  return row == others_.end() ? nullptr : &*row;
}

std::vector<std::string> StressRunner::command(const StressScene& scene, const StressRender& how,
                                               const std::string& file, const std::string& out) const {
  const Engine* other_engine = other(how.engine);
  const Engine row =
      other_engine != nullptr ? *other_engine : own_row({scene.width, scene.height, how.spp, how.seed, how.engine, {}});
  CommandValues values;
  values.photonproof = program_;
  values.suite = fs::current_path();
  values.scene = file;
  values.output = out;
  values.stats = fs::path(out).replace_extension(".stats.json");
  values.scene_name = "stress";
  values.width = scene.width;
  values.height = scene.height;
  values.threads = 1;
  values.seed = how.seed;
  values.budget = row.accepts("spp") ? Budget{"spp", static_cast<double>(how.spp)}
                                     : Budget{row.budget_kinds.empty() ? "" : row.budget_kinds.front(), 1};
  std::vector<std::string> words = fill_command(row.command, values);
  if (other_engine != nullptr) return words;
  words.insert(words.end(), {"--sampler", "independent", "--threads", "1", "--checkpoint", "0"});
  words.insert(words.end(), scene.arguments.begin(), scene.arguments.end());
  return words;
}

std::string StressRunner::identity(const StressScene& scene, const StressRender& how) const {
  std::string text = checksum_ + "\n" + scene_text(scene);
  for (const std::string& part : command(scene, how, "", "")) text += "\n" + part;
  return text;
}

LevelEvidence StressRunner::render(const StressScene& scene, const StressRender& how) const {
  const ScratchFolder scratch("stress");
  const Engine* engine = other(how.engine);
  const bool is_own = engine == nullptr;
  const fs::path assets = folder_ / "assets",
                 out = scratch.path() / ("image." + (is_own ? "exr" : engine->image_extension));
  const fs::path file = is_own ? scratch.path() / "scene.xml" : assets / (scratch.path().filename().string() + ".xml");
  write_file_atomically(file, scene_text(scene));
  const ProcessOutcome outcome = run_command(command(scene, how, file.string(), out.string()));
  if (!is_own) fs::remove(file);
  LevelEvidence evidence;
  evidence.samples = how.spp;
  evidence.ending = outcome.sentence();
  evidence.message = last_line(outcome.standard_error);
  leave_out(scratch.path(), evidence.message);
  evidence.refused = outcome.end == ProcessOutcome::End::exited && !evidence.message.empty() &&
                     (outcome.exit_code == 2 || (!is_own && outcome.exit_code > 0));
  evidence.states_noise = is_own;
  const bool has_ended = outcome.end == ProcessOutcome::End::exited && outcome.exit_code <= 1;
  if (has_ended && fs::exists(out)) evidence.picture = read_rendering(out.string());
  EngineStats stats = read_engine_stats(scratch.path() / "image.stats.json");
  evidence.losses = std::move(stats.losses);
  for (std::string& loss : evidence.losses) leave_out(scratch.path(), loss);
  evidence.relative_bias = stats.counts["relative_bias"];
  return evidence;
}

ProcessOutcome StressRunner::run(std::vector<std::string> arguments) const {
  arguments.insert(arguments.begin(), program_.string());
  return run_command(arguments);
}

ProcessOutcome StressRunner::run_command(const std::vector<std::string>& command) const {
  ProcessOptions options;
  options.wall_limit_seconds = render_limit;
  options.interrupt = interrupt_;
  options.samples_peak = false;
  ProcessOutcome outcome = usual_executor().run(command, options);
  if (outcome.end == ProcessOutcome::End::interrupted || (interrupt_ != nullptr && *interrupt_))
    throw StressInterrupted();
  return outcome;
}

Rendering StressRunner::reference(const StressScene& scene, const StressRender& how) {
  const std::string key = content_key({{"render", identity(scene, how)}});
  const fs::path kept = folder_ / "references" / (key + ".exr"), refusal = fs::path(kept).replace_extension(".txt");
  std::shared_ptr<std::mutex> making;
  {
    const std::lock_guard lock(guard_);
    std::shared_ptr<std::mutex>& own = making_[key];
    if (!own) own = std::make_shared<std::mutex>();
    making = own;
  }
  const std::lock_guard lock(*making);
  if (fs::exists(kept)) return read_rendering(kept.string());
  if (fs::exists(refusal)) throw InputError(how.engine, read_file(refusal));
  const LevelEvidence evidence = render(scene, how);
  if (!evidence.picture) {
    if (!evidence.refused) throw ReferenceCrashed{evidence.ending + ": " + evidence.message};
    write_file_atomically(refusal, evidence.message);
    throw InputError(how.engine, evidence.message);
  }
  write_exr(kept.string(), *evidence.picture);
  return *evidence.picture;
}

}  // namespace photonproof::inline harness_stress
