// Path tracing with next-event estimation and multiple importance sampling (Veach 1997, chapters 8 to 10; Kajiya 1986).
//   L = sum over vertices of throughput x (w_bsdf Le(hit) + w_light f Le(light sample) cos / pdf)
// Depth counts edges as Mitsuba does: 1 sees emitters only, 2 adds direct light.

#include "renderer/path_integrator.h"

#include <cmath>

#include "renderer/camera_samples.h"
#include "renderer/camera_walk.h"
#include "renderer/direct_light.h"
#include "renderer/parallel.h"
#include "renderer/pass_schedule.h"

namespace photonproof {
namespace {

struct PathPlan {
  PathDescription settings;
  bool lights_can_be_hit = true;  ///< some light has a surface, so that BSDF samples find it and MIS is needed
};

Rgb trace_path(const Scene& scene, const PathPlan& plan, const Ray& ray, Sampler& sampler, RayCounts& counts) {
  const PathDescription& settings = plan.settings;
  CameraWalk walk{ray};
  Rgb radiance(0.0f);
  bool after_delta = true;  // the camera counts: nothing else could have sampled what the first ray finds
  float bsdf_pdf = 0;
  Vec3f p_before = ray.origin;

  for (int depth = 1;; ++depth) {
    const Hit hit = scene.tracer().intersect(walk.ray);
    if (!hit.valid()) break;
    const Rgb emitted = emitted_towards(scene, hit, walk.ray.direction);
    if (max_component(emitted) > 0 && !(depth == 1 && settings.hide_emitters)) {
      const std::uint32_t light = scene.surfaces[hit.surface].light;
      const float weight = after_delta ? 1 : mis_weight(bsdf_pdf, direct_light_pdf(scene, light, p_before, hit));
      radiance += walk.throughput * emitted * weight;
    }
    if (settings.max_depth >= 0 && depth >= settings.max_depth) break;

    const Bsdf& bsdf = scene.bsdf_of(hit);
    const Frame frame(hit.normal);
    const Vec3f wo_local = frame.to_local(-walk.ray.direction);
    if (!is_delta(bsdf) && !scene.lights.empty())
      radiance +=
          walk.throughput * estimate_direct(scene, hit, bsdf, frame, wo_local, plan.lights_can_be_hit, sampler, counts);

    const auto next = walk.scatter(scene, hit, frame, wo_local, depth >= settings.rr_depth, sampler);
    if (!next) break;
    after_delta = next->delta;
    bsdf_pdf = next->pdf;
    p_before = hit.p_world;
    ++counts.bounce;
  }
  return radiance;
}

}  // namespace

void render_path(const Scene& scene, const IntegratorDescription& description, const RenderJob& job, Film& film,
                 RenderStats& stats) {
  PathPlan plan;
  plan.settings = std::get<PathDescription>(description.method);
  plan.lights_can_be_hit =
      std::any_of(scene.lights.begin(), scene.lights.end(), [](const Light& l) { return !is_delta(l); });
  if (!plan.lights_can_be_hit)
    stats.skipped.emplace_back("multiple importance sampling: every light is a point, no ray can hit one");

  const PhaseTimer phase(stats.phases["render"]);
  const Threads threads(job.threads);
  RayTotals totals;
  PassSchedule passes(job.budget.spp.value_or(job.sample_count), job.budget.seconds);
  for (std::int64_t samples = passes.next(); samples > 0; samples = passes.next()) {
    const std::int64_t first = passes.samples_done() - samples;
    for_each_tile(threads, scene.width, scene.height, [&](const Tile& tile) {
      if (first > 0 && job.interrupted()) return;
      RayCounts counts;
      for (int y = tile.y0; y < tile.y1; ++y) {
        for (int x = tile.x0; x < tile.x1; ++x) {
          for (std::int64_t s = first; s < first + samples; ++s) {
            Sampler sampler(job.seed, Stream::camera, pixel_index(scene, x, y), static_cast<std::uint64_t>(s));
            const Ray ray = camera_ray(scene, x, y, s, job.grid, sampler);
            ++counts.camera;
            film.add(x, y, RgbD(trace_path(scene, plan, ray, sampler, counts)), 1);
          }
        }
      }
      totals.add(counts);
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
