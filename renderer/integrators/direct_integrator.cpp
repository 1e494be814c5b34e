// Direct light is the path tracer's, cut after two edges. Both strategies are weighted by the balance heuristic (Veach
// and Guibas 1995); a single strategy has the weight 1.

#include "renderer/integrators/direct_integrator.h"

#include "renderer/integrators/path_integrator.h"
#include "renderer/planning/direct_paths.h"

namespace photonproof::inline renderer_integrators {

void plan_direct(const IntegratorDescription& description, Planner& planner) {
  const auto& method = std::get<DirectDescription>(description.method);
  const auto paths = static_cast<std::size_t>(paths_a_sample(method));
  planner.run("camera paths", "paths of at most 2 edges, " + counted(paths, "path", "paths") + " a camera sample");
  planner.run("direct light", method.bsdf_samples == 0 ? "samples of the lights alone"
                              : method.emitter_samples == 0
                                  ? "rays that meet the lights alone"
                                  : "samples of the lights, weighted against rays that meet them");
  planner.batches();
  planner.direct_light(method.emitter_samples > 0 && method.bsdf_samples > 0);
  planner.no_light_paths();
}

void render_direct(const Scene& scene, const RenderPlan& plan, const RenderJob& job, Film& film, RenderStats& stats) {
  const auto asked = std::get<DirectDescription>(plan.method.method);
  PathSettings settings{.max_depth = 2, .hide_emitters = asked.hide_emitters};
  settings.direct_light = asked.bsdf_samples == 0      ? DirectLight::samples_only
                          : asked.emitter_samples == 0 ? DirectLight::hits_only
                          : plan.skips(Skip::mis)      ? DirectLight::unweighted
                                                       : DirectLight::weighted;
  settings.shows_behind_straight = true;       // as Mitsuba's `direct`, unlike its `path`
  settings.rr_depth = settings.max_depth + 1;  // a path this short needs no roulette

  const std::int64_t paths = paths_a_sample(asked);
  const std::int64_t samples = job.budget.spp.value_or(job.sample_count);
  constexpr std::int64_t most_samples = std::int64_t{1} << 32;  // indices of the sampler
  if (samples > most_samples / paths)
    throw InputError("--spp", std::to_string(samples) + " samples a pixel of " + std::to_string(paths) +
                                  " paths each are more than 2^32");
  RenderJob multiplied = job;
  multiplied.budget.spp = samples * paths;
  trace_path_passes(scene, settings, multiplied, "direct light", film, stats);
  stats.counts["paths_per_sample"] = static_cast<double>(paths);
  stats.counts["samples_per_pixel"] /= static_cast<double>(paths);
}

}  // namespace photonproof::inline renderer_integrators
