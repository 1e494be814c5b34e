#include "harness/stress/level_run.h"

#include <algorithm>
#include <utility>

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
  for (const fs::path& path : {folder / "", fs::proximate(folder) / ""})
    for (std::size_t at = 0; (at = text.find(path.string())) != std::string::npos;)
      text.erase(at, path.string().size());
}

/// The arguments of ImageSource::draw.
struct Asked {
  Engine row;
  std::vector<std::string> further;
  SuiteScene file;  ///< without a path
  std::string text, program;
  std::optional<FilmPart> crop;
  Budget budget;

  ImageEngine engine() const { return {&row, program, further}; }
  ImageScene scene() const { return {&file, text, crop}; }
};

Asked asked(const StressRunner& runner, const StressScene& scene, const StressRender& how) {
  Asked asked;
  const Engine* other = runner.other(how.engine);
  asked.row = other != nullptr ? *other : own_row(how.engine);
  if (other == nullptr) {
    asked.further = {"--sampler", "independent", "--checkpoint", "0"};
    asked.further.insert(asked.further.end(), scene.arguments.begin(), scene.arguments.end());
  }
  asked.file.name = "stress";
  asked.file.width = scene.width;
  asked.file.height = scene.height;
  asked.text = scene_text(scene);
  asked.program = runner.checksum();
  asked.crop = crop_of(scene.scene.sensor.film, scene.width, scene.height);
  asked.budget = asked.row.accepts("spp")
                     ? Budget{"spp", static_cast<double>(how.spp)}
                     : Budget{asked.row.budget_kinds.empty() ? "" : asked.row.budget_kinds.front(), 1};
  return asked;
}

}  // namespace

StressRunner::StressRunner(fs::path program, fs::path folder, std::vector<Engine> others,
                           const std::atomic<bool>* interrupt)
    : program_(std::move(program)),
      folder_(std::move(folder)),
      others_(std::move(others)),
      interrupt_(interrupt),
      checksum_(file_checksum(program_)),
      references_(options(folder_)) {}

const Engine* StressRunner::other(const std::string& engine) const {
  const auto row = std::find_if(others_.begin(), others_.end(), [&](const Engine& e) { return e.name == engine; });
  return row == others_.end() ? nullptr : &*row;
}

ImageSourceOptions StressRunner::options(const fs::path& folder) const {
  return {.use = ImageUse::verdict,
          .folder = folder,
          .program = program_,
          .suite_folder = fs::current_path(),
          .limits = {.seconds = render_limit, .memory_mb = 0, .threads = 1},
          .reused = {Status::ok, Status::bad_image},
          .interrupt = interrupt_};
}

std::string StressRunner::key(const StressScene& scene, const StressRender& how) const {
  const Asked what = asked(*this, scene, how);
  return references_.key(what.engine(), what.scene(), what.budget, how.seed);
}

LevelEvidence StressRunner::draw(const StressScene& scene, const StressRender& how, bool is_kept) {
  const ScratchFolder scratch("stress");
  const bool is_own = other(how.engine) == nullptr;
  Asked what = asked(*this, scene, how);
  what.file.path =
      is_own ? scratch.path() / "scene.xml" : folder_ / "assets" / (scratch.path().filename().string() + ".xml");
  write_file_atomically(what.file.path, what.text);
  ImageSource once(options(scratch.path()));
  ImageSource& source = is_kept ? references_ : once;
  const std::optional<KeptImage> image = source.draw(what.engine(), what.scene(), what.budget, how.seed);
  if (!is_own) fs::remove(what.file.path);
  if (!image || (interrupt_ != nullptr && *interrupt_)) throw StressInterrupted();

  const Result& result = image->kept.result;
  const fs::path results_folder = is_kept ? folder_ : scratch.path();
  const fs::path words = results_folder / image->folder / "stderr.txt";
  const bool has_failed = result.status == Status::unsupported || result.detail.starts_with("exited with ");
  LevelEvidence evidence;
  evidence.samples = how.spp;
  evidence.ending = result.detail.substr(0, result.detail.find(": "));
  if (fs::exists(words)) evidence.message = last_line(read_file(words));
  leave_out(scratch.path(), evidence.message);
  evidence.refused = !evidence.message.empty() && (is_own ? exited_with(result, 2) : has_failed);
  evidence.states_noise = is_own;
  const bool has_ended = result.status == Status::ok || result.status == Status::bad_image || exited_with(result, 1);
  if (has_ended && !result.image.empty()) evidence.picture = read_rendering((results_folder / result.image).string());
  EngineStats stats = source.stats_of(*image);
  evidence.losses = std::move(stats.losses);
  for (std::string& loss : evidence.losses) leave_out(scratch.path(), loss);
  evidence.relative_bias = stats.counts["relative_bias"];
  return evidence;
}

ProcessOutcome StressRunner::run(std::vector<std::string> arguments) const {
  arguments.insert(arguments.begin(), program_.string());
  ProcessOptions options;
  options.wall_limit_seconds = render_limit;
  options.interrupt = interrupt_;
  ProcessOutcome outcome = usual_executor().run(arguments, options);
  if (outcome.end == ProcessOutcome::End::interrupted || (interrupt_ != nullptr && *interrupt_))
    throw StressInterrupted();
  return outcome;
}

Rendering StressRunner::reference(const StressScene& scene, const StressRender& how) {
  LevelEvidence evidence = draw(scene, how, true);
  if (evidence.picture) return *std::move(evidence.picture);
  if (evidence.refused) throw InputError(how.engine, evidence.message);
  throw ReferenceCrashed{evidence.ending + ": " + evidence.message};
}

}  // namespace photonproof::inline harness_stress
