// photonproof render: a scene file to an EXR and a stats JSON beside it.
// Exit codes: 0 done, 1 done but some values are not finite, 2 bad input, 130 interrupted (partial results kept).

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "harness/engine_output.h"
#include "harness/interrupt.h"
#include "harness/scene_options.h"
#include "harness/verbs.h"
#include "renderer/integrator.h"
#include "renderer/parallel.h"
#include "renderer/plan.h"
#include "renderer/timer.h"
#include "renderer/version.h"
#include "scenes/atomic_file.h"

namespace photonproof {
namespace {

struct RenderArguments {
  SceneOptions scene;
  std::string output;
  std::string stats_path;
  std::string integrator;
  std::optional<std::int64_t> spp, photons;
  std::optional<double> seconds;
  std::uint64_t seed = 0;
  int threads = 0;
  int grid = 0;
  SamplerKind sampler = SamplerKind::sobol;
  std::string isa;
  std::vector<std::string> no_skip;
  bool plan = false;
  bool json = false;
  bool quiet = false;
};

std::size_t non_finite_values(const Image& image) {
  return static_cast<std::size_t>(
      std::count_if(image.rgb.begin(), image.rgb.end(), [](float v) { return !std::isfinite(v); }));
}

const char* sampler_name(SamplerKind kind) { return kind == SamplerKind::sobol ? "sobol" : "independent"; }

nlohmann::ordered_json plan_json(const RenderPlan& plan) {
  nlohmann::ordered_json runs, skips;
  for (const PlanStep& step : plan.runs) runs[step.what] = step.how;
  for (const RenderPlan::Decision& d : plan.decisions)
    skips[skip_row(d.skip).name] = {{"skipped", d.skipped}, {"why", d.why}};
  return {{"integrator", plan.integrator}, {"isa", plan.isa}, {"lanes", plan.lanes}, {"runs", runs}, {"skips", skips}};
}

nlohmann::ordered_json stats_json(const RenderArguments& arguments, const Scene& scene, const std::string& integrator,
                                  const RenderStats& stats, const RenderPlan& plan, int threads) {
  return {{"schema_version", 1},       {"engine", "photonproof " + integrator},
          {"version", version_line()}, {"scene", arguments.scene.path},
          {"width", scene.width},      {"height", scene.height},
          {"seed", arguments.seed},    {"sampler", sampler_name(arguments.sampler)},
          {"threads", threads},        {"interrupted", stats.interrupted},
          {"phases", stats.phases},    {"counts", stats.counts},
          {"skipped", stats.skipped},  {"plan", plan_json(plan)}};
}

int run_render(const RenderArguments& arguments) {
  if (arguments.output.empty() && !arguments.plan) throw InputError("--output", "is required, as the EXR to write");
  const std::string stats_path =
      arguments.plan ? "" : checked_stats_path(arguments.stats_path, arguments.output, arguments.scene.path);
  RenderStats stats;
  const Timer load_timer;
  SceneDescription description = load_scene(arguments.scene);
  stats.phases["load"] = load_timer.seconds();
  const std::string name =
      arguments.integrator.empty() ? integrator_name(description.integrator) : arguments.integrator;
  const IntegratorDescription method = with_integrator(description.integrator, name);

  const Timer compile_timer;
  const FilmDescription film_size = description.sensor.film;
  const SkipSwitches skips(arguments.no_skip);
  const Scene scene(description, film_size.width, film_size.height, skips);
  stats.phases["compile"] = compile_timer.seconds();

  stats.counts["bytes_scene"] = static_cast<double>(scene.memory_bytes());
  if (scene.view().tracer != nullptr) stats.counts["bytes_bvh"] = static_cast<double>(scene.view().tracer->bvh_bytes());

  RenderJob job;
  job.budget = {arguments.spp, arguments.photons, arguments.seconds};
  job.seed = arguments.seed;
  job.threads = arguments.threads;
  job.grid = arguments.grid;
  job.sampler = arguments.sampler;
  job.isa = arguments.isa;
  job.skips = skips;
  job.sample_count = description.sensor.sample_count;
  job.interrupt = &interrupt_flag();
  job.progress = progress_line(arguments.quiet);

  const RenderPlan plan = plan_render(scene, method, job);
  if (arguments.plan) {
    std::printf("%s", arguments.json ? (plan_json(plan).dump(2) + "\n").c_str() : plan_text(plan).c_str());
    return 0;
  }

  Film film(scene.width, scene.height);
  find_integrator(name)->render(scene, method, job, film, stats);

  const Timer write_timer;
  Rendering rendering = film.develop();
  rendering.metadata["photonproof:version"] = version_line();
  rendering.metadata["photonproof:sampler"] = sampler_name(arguments.sampler);
  rendering.metadata["photonproof:isa"] = plan.isa;
  rendering.metadata["photonproof:command"] =
      arguments.scene.path + " --integrator " + name + " --seed " + std::to_string(arguments.seed) + " --spp " +
      std::to_string(static_cast<std::int64_t>(stats.counts["samples_per_pixel"]));
  write_exr(arguments.output, rendering);
  stats.phases["write"] = write_timer.seconds();

  const nlohmann::ordered_json json =
      stats_json(arguments, scene, name, stats, plan, Threads(arguments.threads).count());
  write_file_atomically(stats_path, json.dump(2) + "\n");

  if (arguments.json) {
    std::printf("%s\n", json.dump(2).c_str());
  } else {
    std::printf("%s: %s, %dx%d, %.0f samples a pixel, %.2f s\n", arguments.output.c_str(), name.c_str(), scene.width,
                scene.height, stats.counts["samples_per_pixel"], load_timer.seconds());
    std::string left_out;
    for (const RenderPlan::Decision& d : plan.decisions)
      if (d.skipped) left_out += (left_out.empty() ? "" : ", ") + std::string(skip_row(d.skip).name);
    if (!left_out.empty()) std::printf("skipped %s (--plan says why)\n", left_out.c_str());
  }
  const std::size_t broken = non_finite_values(rendering.mean);
  if (broken > 0) std::fprintf(stderr, "%s: %zu values are not finite\n", arguments.output.c_str(), broken);
  if (!stats.interrupted) return broken > 0 ? 1 : 0;
  std::fprintf(stderr, "interrupted: wrote what there was, %.0f samples a pixel at most%s\n",
               stats.counts["samples_per_pixel"],
               film.unsampled_pixels() > 0 ? ", some pixels have none and are black" : "");
  return 130;
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
      ->check(CLI::Range(std::int64_t{1}, std::int64_t{1} << 32));
  verb->add_option("--photons", arguments->photons, "photons emitted for each map over the whole render")
      ->check(CLI::Range(std::int64_t{1}, std::int64_t{1} << 40));
  verb->add_option("--seconds", arguments->seconds, "wall time to render for, instead of --spp")
      ->check(CLI::Range(1e-3, 1e7))
      ->check(is_finite_number)
      ->excludes("--spp");
  verb->add_option("--seed", arguments->seed, "of the random numbers: same seed, same bits")->check(is_seed);
  verb->add_option("--threads", arguments->threads, "worker threads (default: every core)")->check(CLI::Range(0, 1024));
  verb->add_option("--grid", arguments->grid, "samples on the centres of a KxK grid in each pixel")
      ->check(CLI::Range(0, 1024));
  verb->add_option("--sampler", arguments->sampler, "sobol (Owen-scrambled) or independent, to check the other against")
      ->transform(CLI::CheckedTransformer(
          std::map<std::string, SamplerKind>{{"sobol", SamplerKind::sobol}, {"independent", SamplerKind::independent}}))
      ->type_name("NAME");
  std::vector<std::string> isas;
  for (const Kernels* kernels : available_kernels()) isas.emplace_back(kernels->isa);
  verb->add_option("--isa", arguments->isa, "instruction set of the kernels (default: the best this processor has)")
      ->check(CLI::IsMember(isas));
  verb->add_option("--no-skip", arguments->no_skip,
                   "do what the plan would skip: a name that --plan prints, or 'all'; may be repeated")
      ->type_name("NAME")
      ->allow_extra_args(false);
  verb->add_flag("--plan", arguments->plan, "print what would run and what would be skipped, and why; render nothing");
  verb->add_flag("--json", arguments->json, "print the stats as JSON");
  verb->add_flag("--quiet", arguments->quiet, "no progress line");
  verb->callback([arguments, &exit_code] { exit_code = run_render(*arguments); });
}

}  // namespace photonproof
