// The host's part of path tracing: tiles for threads, passes, and the sums of the estimates of kernels/path_kernel.h.

#include "renderer/integrators/path_integrator.h"

#include <algorithm>

#include "renderer/passes/render_loop.h"
#include "renderer/passes/scratch_pool.h"
#include "renderer/passes/tile_film.h"

namespace photonproof::inline renderer_integrators {

void trace_path_passes(const Scene& scene, const PathSettings& settings, const RenderJob& job, const std::string& phase,
                       Film& film, RenderStats& stats) {
  const PhaseTimer timer(stats.phases["render"]);
  const Threads threads(job.threads);
  const NegativeLobes lobes = negative_lobes(scene, job);
  if (lobes.any()) film.separate(lobes);
  RenderLoop loop(job, threads, film, stats, {.phase = phase, .subtracted = lobes.subtracted()});
  ScratchPool scratch(job.kernels().path);
  const auto trace = [&](const CameraTask& camera) {
    std::vector<float> radiance(3 * std::size_t{camera.paths()});
    PathTask task{.scene = &scene.view(), .camera = camera, .settings = settings, .radiance = radiance.data()};
    scratch.trace(task);
    add_samples(film, camera, radiance);
    loop.rays().add(task.counts);
  };
  while (loop.next()) {
    loop.for_each_tile([&](const Tile& tile) {
      trace(camera_task(job, tile, loop.first(), loop.samples()));
      if (loop.negative() > 0)
        trace(camera_task(job, tile, loop.first_negative(), loop.negative(), FilterPart::negative));
    });
  }
}

void plan_path(const IntegratorDescription& description, Planner& planner) {
  const auto& method = std::get<PathDescription>(description.method);
  planner.run("camera paths",
              depth_words(method.max_depth) + ", roulette from depth " + std::to_string(method.rr_depth));
  planner.batches();
  planner.direct_light(true);
  planner.no_light_paths();
}

void render_path(const Scene& scene, const RenderPlan& plan, const RenderJob& job, Film& film, RenderStats& stats) {
  const auto asked = std::get<PathDescription>(plan.method.method);
  trace_path_passes(scene,
                    {asked.max_depth, asked.rr_depth, asked.hide_emitters,
                     plan.skips(Skip::mis) ? DirectLight::unweighted : DirectLight::weighted},
                    job, "path tracing", film, stats);
}

}  // namespace photonproof::inline renderer_integrators
