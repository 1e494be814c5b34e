// photonproof render: a scene file to an EXR and a stats JSON beside it.
// Exit codes: 0 done, 1 done but some values are not finite, 2 bad input, 130 interrupted (partial results kept).

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "harness/cells/available_memory.h"
#include "harness/verbs/engine_output.h"
#include "harness/verbs/interrupt.h"
#include "harness/verbs/scene_options.h"
#include "harness/verbs/verbs.h"
#include "renderer/core/parallel.h"
#include "renderer/core/version.h"
#include "renderer/integrators/check_supported.h"
#include "renderer/integrators/integrator.h"
#include "renderer/scene/scene_notes.h"
#include "scenes/description/output_files.h"
#include "scenes/description/scene_hash.h"
#include "scenes/text/atomic_file.h"
#include "scenes/text/json_text.h"
#include "scenes/text/size_text.h"
#include "scenes/text/timer.h"

namespace photonproof {
namespace {

struct RenderArguments {
  SceneOptions scene;
  std::string output;
  std::string stats_path;
  std::string integrator;
  std::optional<std::int64_t> spp, photons;
  std::optional<double> seconds, target_error;
  std::uint64_t seed = 0;
  int threads = 0;
  int grid = 0;
  std::string sampler = "sobol";
  std::string isa;
  std::vector<std::string> no_skip;
  std::vector<int> crop;  ///< x, y, width, height; empty: the scene's
  double checkpoint_seconds = 60;
  bool resume = false;
  bool plan = false;
  bool json = false;
  bool quiet = false;
};

std::size_t non_finite_values(const Image& image) {
  return static_cast<std::size_t>(
      std::count_if(image.rgb.begin(), image.rgb.end(), [](float v) { return !std::isfinite(v); }));
}

/// The part of the image that is rendered. Throws InputError when it is none of the image.
Tile film_window(const FilmDescription& film, const std::vector<int>& asked) {
  FilmDescription::Crop crop = film.crop.value_or(FilmDescription::Crop{0, 0, film.width, film.height});
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

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text.empty() ? "none" : text;
}

/// The budget is no part of it: the checkpoint knows itself how far it may be changed.
RenderIdentity render_identity(const RenderArguments& arguments, const SceneDescription& description,
                               const RenderPlan& plan, const Tile& window) {
  const FilmDescription& film = description.sensor.film;
  return {{"program", version_line()},
          {"scene's content", scene_hash(description, arguments.scene.defines)},
          {"image", size_text(film.width, film.height) + ", of which " + size_text(window.width(), window.height()) +
                        " from " + std::to_string(window.x0) + "," + std::to_string(window.y0)},
          {"integrator", plan.integrator},
          {"seed", std::to_string(arguments.seed)},
          {"sampler", arguments.sampler},
          {"grid", std::to_string(arguments.grid)},
          {"instruction set", plan.isa},
          {"list of --no-skip", joined(arguments.no_skip)}};
}

std::filesystem::path checkpoint_path(const std::string& output) { return output + ".checkpoint"; }

void remove_checkpoint(const std::filesystem::path& file) {
  std::error_code ignored;
  std::filesystem::remove(file, ignored);
}

nlohmann::ordered_json plan_json(const RenderPlan& plan) {
  nlohmann::ordered_json runs, skips;
  for (const PlanStep& step : plan.runs) runs[step.what] = step.how;
  for (const RenderPlan::Decision& d : plan.decisions)
    skips[skip_row(d.skip).name] = {{"skipped", d.skipped}, {"why", d.why}};
  return {{"integrator", plan.integrator}, {"isa", plan.isa}, {"lanes", plan.lanes}, {"runs", runs}, {"skips", skips}};
}

nlohmann::ordered_json stats_json(const RenderArguments& arguments, const std::string& integrator,
                                  const RenderStats& stats, const RenderPlan& plan, int threads,
                                  const Rendering& rendering) {
  return {{"schema_version", 1},
          {"engine", "photonproof " + integrator},
          {"version", version_line()},
          {"scene", arguments.scene.path},
          {"width", rendering.mean.width},
          {"height", rendering.mean.height},
          {"seed", arguments.seed},
          {"sampler", arguments.sampler},
          {"threads", threads},
          {"interrupted", stats.interrupted},
          {"phases", stats.phases},
          {"counts", stats.counts},
          {"skipped", stats.skipped},
          {"losses", stats.losses},
          {"plan", plan_json(plan)}};
}

/// Says on stderr what the scene does not get as it asks for; the same, for the stats.
std::vector<std::string> say_notes(const SceneDescription& description, const SceneParts& scene) {
  std::vector<std::string> losses;
  for (const SceneNote& note : scene_notes(description, scene)) {
    losses.push_back(note.where + ": " + note.text);
    std::fprintf(stderr, "%s: warning: %s\n", note.where.c_str(), note.text.c_str());
  }
  return losses;
}

const std::map<std::string, SamplerKind>& sampler_kinds() {
  static const std::map<std::string, SamplerKind> kinds{{"sobol", SamplerKind::sobol},
                                                        {"independent", SamplerKind::independent}};
  return kinds;
}

IntegratorDescription method_of(const RenderArguments& arguments, const SceneDescription& description) {
  if (arguments.integrator.empty()) return description.integrator;
  return with_integrator(description.integrator, arguments.integrator);
}

RenderJob render_job(const RenderArguments& arguments, const SceneDescription& description) {
  RenderJob job;
  job.budget = {arguments.spp, arguments.photons, arguments.seconds, arguments.target_error};
  job.seed = arguments.seed;
  job.threads = arguments.threads;
  job.grid = arguments.grid;
  job.sampler = sampler_kinds().at(arguments.sampler);
  job.isa = arguments.isa;
  job.skips = SkipSwitches(arguments.no_skip);
  job.sample_count = description.sensor.sample_count;
  job.integrator_place = description.where(description.integrator.loc);
  job.interrupt = &interrupt_flag();
  job.progress = progress_line(arguments.quiet);
  return job;
}

int print_plan(const RenderArguments& arguments) {
  if (arguments.resume) throw InputError("--resume", "does nothing with --plan, which renders nothing");
  const SceneDescription description = load_scene(arguments.scene);
  const IntegratorDescription method = method_of(arguments, description);
  const RenderJob job = render_job(arguments, description);
  check_supported(description, method);
  check_job(job, method);
  const FilmDescription& film = description.sensor.film;
  film_window(film, arguments.crop);
  const SceneParts parts(description, film.width, film.height);
  const RenderPlan plan = plan_render(analyse(parts), method, job);
  say_notes(description, parts);
  std::printf("%s", arguments.json ? (json_text(plan_json(plan)) + "\n").c_str() : plan_text(plan).c_str());
  return 0;
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

int run_render(const RenderArguments& arguments) {
  if (arguments.plan) return print_plan(arguments);
  if (arguments.output.empty()) throw InputError("--output", "is required, as the EXR to write");
  const std::string stats_path = checked_stats_path(arguments.stats_path, arguments.output, arguments.scene.path);
  CheckpointPolicy checkpoint{checkpoint_path(arguments.output), arguments.checkpoint_seconds, arguments.resume, {}};
  if (!checkpoint.finds_what_it_resumes())
    std::fprintf(stderr, "%s: no such checkpoint, the render starts from the beginning\n",
                 checkpoint.file.string().c_str());
  for (const std::filesystem::path& file :
       {checkpoint.file, std::filesystem::path(arguments.output), std::filesystem::path(stats_path)})
    remove_abandoned_temporaries(file);

  RenderStats stats;
  const Timer load_timer;
  const SceneDescription description = load_scene(arguments.scene);
  check_outputs({arguments.output, stats_path, checkpoint.file}, scene_inputs(description));
  stats.phases["load"] = load_timer.seconds();
  const IntegratorDescription method = method_of(arguments, description);
  const std::string name = integrator_name(method);
  RenderJob job = render_job(arguments, description);
  check_supported(description, method);
  check_job(job, method);

  const Timer compile_timer;
  const FilmDescription& film_size = description.sensor.film;
  const Tile window = film_window(film_size, arguments.crop);
  check_memory(description, window, arguments.checkpoint_seconds);
  SceneParts parts(description, film_size.width, film_size.height);
  const RenderPlan plan = plan_render(analyse(parts), method, job);
  stats.losses = say_notes(description, parts);
  const Scene scene(std::move(parts), plan.scene);
  stats.phases["compile"] = compile_timer.seconds();

  stats.counts["bytes_scene"] = static_cast<double>(scene.memory_bytes());
  if (scene.view().tracer != nullptr) stats.counts["bytes_bvh"] = static_cast<double>(scene.view().tracer->bvh_bytes());

  checkpoint.identity = render_identity(arguments, description, plan, window);
  job.checkpoint = checkpoint;

  Film film(window);
  const std::size_t said = stats.losses.size();
  render(scene, plan, job, film, stats);
  for (std::size_t i = said; i < stats.losses.size(); ++i)
    std::fprintf(stderr, "%s: warning: %s\n", arguments.scene.path.c_str(), stats.losses[i].c_str());

  const Timer write_timer;
  Rendering rendering = film.develop();
  rendering.metadata["photonproof:version"] = version_line();
  rendering.metadata["photonproof:sampler"] = arguments.sampler;
  rendering.metadata["photonproof:isa"] = plan.isa;
  rendering.metadata["photonproof:command"] =
      arguments.scene.path + " --integrator " + name + " --seed " + std::to_string(arguments.seed) + " --spp " +
      std::to_string(static_cast<std::int64_t>(stats.counts["samples_per_pixel"]));
  write_exr(arguments.output, rendering);
  stats.phases["write"] = write_timer.seconds();

  const nlohmann::ordered_json json =
      stats_json(arguments, name, stats, plan, Threads(arguments.threads).count(), rendering);
  write_file_atomically(stats_path, json_text(json) + "\n");
  if (!stats.interrupted && (checkpoint.interval_seconds > 0 || checkpoint.resume)) remove_checkpoint(checkpoint.file);

  if (arguments.json) {
    std::printf("%s\n", json_text(json).c_str());
  } else {
    std::printf("%s: %s, %dx%d, %.0f samples a pixel, %.2f s\n", arguments.output.c_str(), name.c_str(),
                rendering.mean.width, rendering.mean.height, stats.counts["samples_per_pixel"], load_timer.seconds());
    std::string left_out;
    for (const RenderPlan::Decision& d : plan.decisions)
      if (d.skipped) left_out += (left_out.empty() ? "" : ", ") + std::string(skip_row(d.skip).name);
    if (!left_out.empty()) std::printf("skipped %s (--plan says why)\n", left_out.c_str());
  }
  return outcome(arguments, stats, film, rendering);
}

}  // namespace

void add_render_verb(CLI::App& program, int& exit_code) {
  auto arguments = std::make_shared<RenderArguments>();
  CLI::App* verb =
      program.add_subcommand("render", "Render a scene to an EXR with per-pixel variance and a stats JSON");
  add_scene_options(*verb, arguments->scene);
  verb->add_option("-o,--output", arguments->output, "EXR to write");
  verb->add_option("--stats", arguments->stats_path, "stats JSON to write (default: beside the EXR, .stats.json)");
  std::vector<std::string> names;
  for (const Integrator& row : integrators()) names.emplace_back(row.name);
  verb->add_option("--integrator", arguments->integrator, "instead of the scene's own")->check(CLI::IsMember(names));
  verb->add_option("--spp", arguments->spp, "samples a pixel (default: the scene's)")
      ->transform(whole_number(1, std::int64_t{1} << 32))
      ->type_name("N");
  verb->add_option("--photons", arguments->photons, "photons emitted for each map over the whole render")
      ->transform(whole_number(1, std::int64_t{1} << 40))
      ->type_name("N");
  verb->add_option("--seconds", arguments->seconds, "wall time to render for, instead of --spp")
      ->check(CLI::Range(1e-3, 1e7))
      ->check(is_finite_number)
      ->excludes("--spp");
  verb->add_option(
          "--target-error", arguments->target_error,
          "render until the image's relative standard error, as its samples tell it, is at most this: 0.05 for "
          "a relmse of 0.0025")
      ->check(CLI::Range(1e-6, 10.0))
      ->check(is_finite_number)
      ->excludes("--spp")
      ->excludes("--seconds");
  verb->add_option("--seed", arguments->seed, "of the random numbers: same seed, same bits")->check(is_seed);
  verb->add_option("--threads", arguments->threads, "worker threads (default: every core)")->check(CLI::Range(0, 1024));
  verb->add_option("--grid", arguments->grid, "samples on the centres of a KxK grid in each pixel")
      ->check(CLI::Range(0, 1024));
  verb->add_option("--sampler", arguments->sampler, "sobol (Owen-scrambled) or independent, to check the other against")
      ->check(CLI::IsMember({"sobol", "independent"}));
  std::vector<std::string> isas;
  for (const Kernels* kernels : available_kernels()) isas.emplace_back(kernels->isa);
  verb->add_option("--isa", arguments->isa, "instruction set of the kernels (default: the best this processor has)")
      ->check(CLI::IsMember(isas));
  verb->add_option("--no-skip", arguments->no_skip,
                   "do what the plan would skip: a name that --plan prints, or 'all'; may be repeated")
      ->type_name("NAME")
      ->allow_extra_args(false);
  verb->add_option("--crop", arguments->crop,
                   "render this part of the image alone, in pixels from its upper left corner")
      ->expected(4)
      ->type_name("X Y WIDTH HEIGHT");
  verb->add_option("--checkpoint", arguments->checkpoint_seconds,
                   "seconds between checkpoints, left as OUTPUT.checkpoint until the render is complete; 0: none")
      ->check(CLI::Range(0.0, 1e7))
      ->check(is_finite_number)
      ->capture_default_str();
  verb->add_flag("--resume", arguments->resume,
                 "go on from OUTPUT.checkpoint, to the same bits as a render never stopped; without one, begin anew");
  verb->add_flag("--plan", arguments->plan, "print what would run and what would be skipped, and why; render nothing");
  verb->add_flag("--json", arguments->json, "print the stats as JSON");
  verb->add_flag("--quiet", arguments->quiet, "no progress line");
  verb->callback([arguments, &exit_code] { exit_code = run_render(*arguments); });
}

}  // namespace photonproof
