#include "harness/verbs/render_run.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "harness/cells/available_memory.h"
#include "harness/verbs/engine_output.h"
#include "harness/verbs/interrupt.h"
#include "harness/verbs/render_json.h"
#include "harness/verbs/render_presets.h"
#include "renderer/core/parallel.h"
#include "renderer/core/version.h"
#include "renderer/integrators/check_supported.h"
#include "renderer/integrators/integrator.h"
#include "renderer/passes/view.h"
#include "renderer/scalar/coverage.h"
#include "renderer/scene/precision_notes.h"
#include "renderer/scene/scene_notes.h"
#include "scenes/description/output_files.h"
#include "scenes/description/scene_hash.h"
#include "scenes/images/mean_error.h"
#include "scenes/text/atomic_file.h"
#include "scenes/text/json_text.h"
#include "scenes/text/size_text.h"
#include "scenes/text/timer.h"

namespace photonproof {
namespace {

namespace fs = std::filesystem;

std::size_t non_finite_values(const Image& image) {
  return static_cast<std::size_t>(
      std::count_if(image.rgb.begin(), image.rgb.end(), [](float v) { return !std::isfinite(v); }));
}

/// The part of the image that is rendered. Throws InputError when it is none of the image.
Tile film_window(const FilmDescription& film, const std::vector<int>& asked) {
  FilmDescription::Crop crop = film.window();
  if (!asked.empty()) crop = {asked[0], asked[1], asked[2], asked[3]};
  const bool inside = crop.x >= 0 && crop.y >= 0 && crop.width > 0 && crop.height > 0 &&
                      crop.width <= film.width - crop.x && crop.height <= film.height - crop.y;
  const auto words = [](int a, int b) { return std::to_string(a) + " " + std::to_string(b); };
  if (!inside)
    throw InputError("--crop", words(crop.x, crop.y) + " " + words(crop.width, crop.height) +
                                   " is no part of the image of " + size_text(film.width, film.height) + " pixels");
  return {crop.x, crop.y, crop.x + crop.width, crop.y + crop.height};
}

/// Throws InputError when the image alone would take more memory than there is, before it is filled for hours.
void check_memory(const SceneDescription& description, const Tile& window, double checkpoint_seconds) {
  const std::optional<std::uint64_t> available = available_memory();
  // A checkpoint is a copy of the film. At the end, mean and variance stand beside it, and once more as the file's
  // rows.
  constexpr std::size_t written = 2 * 6 * sizeof(float);
  const std::size_t copies = checkpoint_seconds > 0 ? std::max(Film::bytes_a_pixel(), written) : written;
  const std::uint64_t bytes = std::uint64_t{Film::bytes_a_pixel() + copies} *
                              static_cast<std::uint64_t>(window.width()) * static_cast<std::uint64_t>(window.height());
  if (!available || bytes <= *available) return;
  const auto megabytes = [](std::uint64_t n) { return std::to_string(n >> 20) + " MB"; };
  throw InputError(description.where(description.sensor.loc),
                   "an image of " + size_text(window.width(), window.height()) + " pixels takes " + megabytes(bytes) +
                       " of memory, of which " + megabytes(*available) +
                       " are free: render it smaller or, by --crop, in parts");
}

/// The budget is no part of it: the checkpoint knows itself how far it may be changed.
RenderIdentity render_identity(const RenderArguments& arguments, const SceneDescription& description,
                               const RenderPlan& plan, const Tile& window) {
  const FilmDescription& film = description.sensor.film;
  return {
      {"program", version_line()},
      {"scene's content", scene_hash(description, arguments.scene.defines)},
      {"image", size_text(film.width, film.height) + ", of which " + size_text(window.width(), window.height()) +
                    " from " + std::to_string(window.x0) + "," + std::to_string(window.y0)},
      {"integrator", plan.integrator},
      {"preset", arguments.preset.empty() ? "none" : arguments.preset},
      {"view", view_row(plan.view).name},
      {"seed", std::to_string(arguments.seed)},
      {"sampler", arguments.sampler},
      {"grid", std::to_string(arguments.grid)},
      {"instruction set", plan.isa},
      {"list of --no-skip", arguments.no_skip.empty() ? "none" : fmt::format("{}", fmt::join(arguments.no_skip, " "))}};
}

fs::path checkpoint_path(const std::string& output) { return output + ".checkpoint"; }

void remove_checkpoint(const fs::path& file) {
  std::error_code ignored;
  fs::remove(file, ignored);
}

/// Says on stderr what the scene does not get as it asks for; the same, for the stats.
std::vector<std::string> say(const std::vector<SceneNote>& notes) {
  std::vector<std::string> losses;
  for (const SceneNote& note : notes) {
    losses.push_back(note.where + ": " + note.text);
    std::fprintf(stderr, "%s: warning: %s\n", note.where.c_str(), note.text.c_str());
  }
  return losses;
}

void say_if_spots_are_missed(const SceneDescription& description, const Scene& scene, const RenderPlan& plan,
                             const Film& film, RenderStats& stats) {
  if (plan.integrator == "bdpt" || plan.integrator == "ptracer") return;
  const Tile& window = film.window();
  const double pixels = static_cast<double>(window.width()) * window.height();
  const std::vector<std::string> losses =
      say(notes_on_missed_spots(description, scene, pixels * stats.counts.at("samples_per_pixel")));
  stats.losses.insert(stats.losses.end(), losses.begin(), losses.end());
}

void say_if_variance_is_lost(const Film& film, RenderStats& stats) {
  const VarianceInFloat variance = film.variance_in_float();
  if (variance.lost == 0) return;
  stats.losses.push_back(
      "the variance of " + std::to_string(variance.lost) + (variance.lost == 1 ? " pixel is" : " pixels is") +
      " beyond single precision, as radiances above 1e19 or below 1e-19 make it: " +
      (variance.fits ? "its layer says little or nothing there" : "the image has no variance layer"));
}

IntegratorDescription method_of(const RenderArguments& arguments, const SceneDescription& description) {
  IntegratorDescription method = description.integrator;
  if (!arguments.integrator.empty()) method = with_integrator(method, arguments.integrator);
  if (!arguments.indirect.empty()) {
    auto* photons = std::get_if<PhotonMapperDescription>(&method.method);
    if (photons == nullptr)
      throw InputError("--indirect", "does nothing with integrator '" + integrator_name(method) + "'");
    for (const auto& word : indirect_words)
      if (arguments.indirect == word.text) photons->indirect = word.value;
  }
  return method;
}

RenderJob render_job(const RenderArguments& arguments, const SceneDescription& description) {
  RenderJob job;
  job.budget = {arguments.spp, arguments.photons, arguments.seconds, arguments.target_error};
  job.seed = arguments.seed;
  job.threads = arguments.threads;
  job.grid = arguments.grid;
  job.sampler = arguments.sampler == "sobol" ? SamplerKind::sobol : SamplerKind::independent;
  job.isa = arguments.isa;
  job.view = view_named(arguments.view);
  job.skips = SkipSwitches(arguments.no_skip);
  job.sample_count = description.sensor.sample_count;
  job.integrator_place = description.where(description.integrator.loc);
  job.interrupt = &interrupt_flag();
  job.progress = progress_line(arguments.quiet);
  return job;
}

/// What is asked for, as far as it can be known before the scene is compiled.
struct Request {
  std::string preset;  ///< what it does; empty: there is none
  SceneDescription description;
  IntegratorDescription method;
  RenderJob job;
  Tile window;
};

/// Throws InputError where it cannot be done, or would write over what the scene is read from.
Request request_of(const RenderArguments& arguments, const std::vector<fs::path>& outputs) {
  Request request;
  request.description = load_scene(arguments.scene);
  if (!outputs.empty()) check_outputs(outputs, scene_inputs(request.description));
  const RenderPreset* preset = preset_named(arguments.preset);
  if (preset != nullptr) {
    request.preset = preset->apply(request.description, !arguments.scene.size.empty());
    if (!arguments.integrator.empty() && arguments.integrator != integrator_name(request.description.integrator))
      throw InputError("--preset", "'" + arguments.preset + "' is of integrator '" +
                                       integrator_name(request.description.integrator) + "', not of '" +
                                       arguments.integrator + "'");
  }
  request.method = method_of(arguments, request.description);
  request.job = render_job(arguments, request.description);
  if (preset != nullptr && request.job.grid == 0 && request.job.view != View::photons) request.job.grid = preset->grid;
  check_supported(request.description, request.method);
  check_job(request.job, request.method);
  request.window = film_window(request.description.sensor.film, arguments.crop);
  return request;
}

SceneParts parts_of(const SceneDescription& description) {
  return {description, description.sensor.film.width, description.sensor.film.height};
}

RenderPlan plan_of(const Request& request, const SceneParts& parts) {
  RenderPlan plan = plan_render(analyse(parts), request.method, request.job);
  if (!request.preset.empty()) plan.runs.insert(plan.runs.begin(), {"preset", request.preset});
  return plan;
}

int print_plan(const RenderArguments& arguments) {
  if (arguments.resume) throw InputError("--resume", "does nothing with --plan, which renders nothing");
  const Request request = request_of(arguments, {});
  SceneParts parts = parts_of(request.description);
  RenderPlan plan = plan_of(request, parts);
  say(scene_notes(request.description, parts));
  if (plan.may_lose_light) find_lost_light(Scene(std::move(parts), plan.scene), plan);
  std::printf("%s", arguments.json ? (json_text(plan_json(plan)) + "\n").c_str() : plan_text(plan).c_str());
  return 0;
}

/// With `before`, where it is not the whole image.
std::string view_words(const RenderPlan& plan, const char* before) {
  return plan.view == View::whole ? "" : before + std::string(view_row(plan.view).name);
}

Rendering developed(const RenderArguments& arguments, const Request& request, const RenderPlan& plan,
                    const Scene& scene, RenderStats& stats, const Film& film) {
  Rendering rendering = film.develop();
  const FilmDescription& whole = request.description.sensor.film;
  const Tile& window = request.window;
  if (window != Tile{0, 0, whole.width, whole.height})
    rendering.place = {window.x0, window.y0, whole.width, whole.height};
  if (whole.alpha) {
    const PhaseTimer timer(stats.phases["alpha"]);
    rendering.alpha = coverage(scene, request.job, request.method.limits().hide_emitters, window,
                               static_cast<std::int64_t>(stats.counts.at("samples_per_pixel")));
  }
  rendering.metadata["photonproof:version"] = version_line();
  rendering.metadata["photonproof:sampler"] = arguments.sampler;
  rendering.metadata["photonproof:isa"] = plan.isa;
  if (stats.counts.contains("photons_stored_global") || stats.counts.contains("photons_stored_caustic"))
    store_shared_photons(rendering);
  rendering.metadata["photonproof:command"] =
      arguments.scene.path + " --integrator " + plan.integrator + view_words(plan, " --view ") + " --seed " +
      std::to_string(arguments.seed) + " --spp " +
      std::to_string(static_cast<std::int64_t>(stats.counts.at("samples_per_pixel")));
  return rendering;
}

void print_summary(const RenderArguments& arguments, const RenderPlan& plan, const RenderStats& stats,
                   const Tile& window, double seconds) {
  std::printf("%s: %s, %dx%d, %.0f samples a pixel, %.2f s\n", arguments.output.c_str(),
              (plan.integrator + view_words(plan, ", view ")).c_str(), window.width(), window.height(),
              stats.counts.at("samples_per_pixel"), seconds);
  for (const std::string& choice : stats.choices) std::printf("%s\n", choice.c_str());
  std::string left_out;
  for (const RenderPlan::Decision& d : plan.decisions)
    if (d.skipped) left_out += (left_out.empty() ? "" : ", ") + std::string(skip_row(d.skip).name);
  if (!left_out.empty()) std::printf("skipped %s (--plan says why)\n", left_out.c_str());
}

/// Warnings and the exit code.
int outcome(const RenderArguments& arguments, const RenderStats& stats, const Film& film, const Rendering& rendering) {
  const std::size_t broken = non_finite_values(rendering.mean);
  if (broken > 0) std::fprintf(stderr, "%s: %zu values are not finite\n", arguments.output.c_str(), broken);
  if (!stats.checkpoint_problem.empty())
    std::fprintf(stderr, "no checkpoint could be left: %s\n", stats.checkpoint_problem.c_str());
  if (!stats.interrupted) return broken > 0 ? 1 : 0;
  std::error_code ignored;
  const bool resumable = std::filesystem::exists(checkpoint_path(arguments.output), ignored);
  std::fprintf(stderr, "interrupted: wrote what there was, %.0f samples a pixel at most%s%s\n",
               stats.counts.at("samples_per_pixel"),
               film.unsampled_pixels() > 0 ? ", some pixels have none and are black" : "",
               resumable ? "; --resume goes on from there" : "");
  return 130;
}

/// The scene as the plan wants it, with what it took and what it lacks in the stats, and what is lost in the plan.
std::unique_ptr<const Scene> built(const Request& request, SceneParts parts, RenderPlan& plan, RenderStats& stats) {
  std::vector<SceneNote> notes = scene_notes(request.description, parts);
  auto scene = std::make_unique<const Scene>(std::move(parts), plan.scene);
  find_lost_light(*scene, plan);
  if (plan.lost_light) notes.push_back({request.description.where(request.method.loc), plan.lost_light->text()});
  stats.losses = say(notes);
  stats.counts["bytes_scene"] = static_cast<double>(scene->memory_bytes());
  if (const Tracer* tracer = scene->view().tracer) stats.counts["bytes_bvh"] = static_cast<double>(tracer->bvh_bytes());
  return scene;
}

/// Its files are named and can be written, and what earlier processes left half-written is gone.
CheckpointPolicy checkpoint_of(const RenderArguments& arguments, const std::string& stats_path) {
  CheckpointPolicy checkpoint{checkpoint_path(arguments.output), arguments.checkpoint_seconds, arguments.resume, {}};
  if (!checkpoint.finds_what_it_resumes())
    std::fprintf(stderr, "%s: no such checkpoint, the render starts from the beginning\n",
                 checkpoint.file.string().c_str());
  for (const fs::path& file : {checkpoint.file, fs::path(arguments.output), fs::path(stats_path)})
    remove_abandoned_temporaries(file);
  return checkpoint;
}

int render_to_files(const RenderArguments& arguments) {
  if (arguments.output.empty()) throw InputError("--output", "is required, as the EXR to write");
  const std::string stats_path = checked_stats_path(arguments.stats_path, arguments.output, arguments.scene.path);
  CheckpointPolicy checkpoint = checkpoint_of(arguments, stats_path);

  RenderStats stats;
  const Timer load_timer;
  Request request = request_of(arguments, {arguments.output, stats_path, checkpoint.file});
  stats.phases["load"] = load_timer.seconds();
  const Timer compile_timer;
  check_memory(request.description, request.window, arguments.checkpoint_seconds);
  SceneParts parts = parts_of(request.description);
  RenderPlan plan = plan_of(request, parts);
  const std::unique_ptr<const Scene> scene = built(request, std::move(parts), plan, stats);
  stats.phases["compile"] = compile_timer.seconds();

  checkpoint.identity = render_identity(arguments, request.description, plan, request.window);
  request.job.checkpoint = checkpoint;
  Film film(request.window);
  const std::size_t said = stats.losses.size();
  render(*scene, plan, request.job, film, stats);
  say_if_variance_is_lost(film, stats);
  for (std::size_t i = said; i < stats.losses.size(); ++i)
    std::fprintf(stderr, "%s: warning: %s\n", arguments.scene.path.c_str(), stats.losses[i].c_str());
  say_if_spots_are_missed(request.description, *scene, plan, film, stats);

  const Rendering rendering = developed(arguments, request, plan, *scene, stats, film);
  const Timer write_timer;
  write_exr(arguments.output, rendering);
  stats.phases["write"] = write_timer.seconds();
  const nlohmann::ordered_json json = stats_json(arguments, plan, stats, Threads(arguments.threads).count(),
                                                 request.window.width(), request.window.height());
  write_file_atomically(stats_path, json_text(json) + "\n");
  if (!stats.interrupted && (checkpoint.interval_seconds > 0 || checkpoint.resume)) remove_checkpoint(checkpoint.file);
  if (arguments.json)
    std::printf("%s\n", json_text(json).c_str());
  else
    print_summary(arguments, plan, stats, request.window, load_timer.seconds());
  return outcome(arguments, stats, film, rendering);
}

}  // namespace

int run_render(const RenderArguments& arguments) {
  return arguments.plan ? print_plan(arguments) : render_to_files(arguments);
}

}  // namespace photonproof
