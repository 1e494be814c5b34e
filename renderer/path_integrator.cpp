// The host's part of path tracing: tiles to threads, passes, and the sums of what kernels/path_kernel.h estimates.

#include "renderer/path_integrator.h"

#include <algorithm>

#include "renderer/parallel.h"
#include "renderer/pass_schedule.h"
#include "renderer/plan.h"
#include "renderer/ray_totals.h"
#include "renderer/tile_film.h"

namespace photonproof {

void render_path(const Scene& scene, const IntegratorDescription& description, const RenderJob& job, Film& film,
                 RenderStats& stats) {
  const auto asked = std::get<PathDescription>(description.method);
  const RenderPlan plan = plan_render(scene, description, job);
  stats.skipped = plan.skipped();
  const PathSettings settings{asked.max_depth, asked.rr_depth, asked.hide_emitters, !plan.skips(Skip::mis)};

  const PhaseTimer phase(stats.phases["render"]);
  const Threads threads(job.threads);
  RayTotals totals;
  PassSchedule passes(job.budget.spp.value_or(job.sample_count), job.budget.seconds);
  for (std::int64_t samples = passes.next(); samples > 0; samples = passes.next()) {
    const std::int64_t first = passes.samples_done() - samples;
    for_each_tile(threads, scene.width, scene.height, [&](const Tile& tile) {
      if (first > 0 && job.interrupted()) return;
      const CameraTask camera = camera_task(job, tile, first, samples);
      std::vector<float> radiance(3 * std::size_t{camera.paths()});
      std::vector<std::uint32_t> scratch(job.kernels().path_scratch);
      PathTask task{.scene = &scene.view(),
                    .camera = camera,
                    .settings = settings,
                    .radiance = radiance.data(),
                    .scratch = scratch.data()};
      job.kernels().trace_paths(task);
      add_samples(film, camera, radiance);
      totals.add(task.counts);
    });
    if (job.progress) job.progress(passes.fraction(), "path tracing");
    if (job.interrupted()) {
      stats.interrupted = true;
      break;
    }
  }
  totals.store(stats);
  stats.counts["samples_per_pixel"] = static_cast<double>(passes.samples_done());
}

}  // namespace photonproof
