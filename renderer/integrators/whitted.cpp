// Ray tracing after Whitted (1980), "An Improved Illumination Model for Shaded Display". It follows mirrors and both
// branches of smooth dielectrics. Other surfaces get direct light alone, from one point of each light a sample. No
// light goes between diffuse surfaces, nor through glass or by mirrors to diffuse ones. Branches end at max_depth
// edges, and where they could change the pixel by less than `faint` of their radiance.

#include "renderer/integrators/whitted.h"

#include <array>

#include "renderer/scalar/scalar_passes.h"
#include "renderer/scalar/scalar_tracer.h"

namespace photonproof::inline renderer_integrators {
namespace {

constexpr float faint = 1.0f / 1024;
constexpr int deepest = 64;  ///< limit of unlimited branches: two facing mirrors of reflectance 1 never get faint

namespace whitted_dimension {
constexpr std::uint32_t in_pixel = 0, lens = 1, first_hit = 2;
}  // namespace whitted_dimension

class WhittedTracer : ScalarTracer {
 public:
  WhittedTracer(const Scene& scene, const PathLimits& limits, int grid)
      : ScalarTracer(scene, limits, std::int64_t{scene.width} * scene.height), grid_(grid) {
    if (limits_.max_depth < 0) limits_.max_depth = deepest;
  }

  Rgb sample(int x, int y, const PathSampler& draws, ScalarWork& work) const {
    const std::optional<Ray> first =
        camera_.ray(x, y, draws, grid_, whitted_dimension::in_pixel, draws.two(whitted_dimension::lens), work.part);
    if (!first) return Rgb(0.0f);
    ++work.rays.camera;
    std::uint32_t dimension = whitted_dimension::first_hit;
    return follow(*first, Rgb(1.0f), {1, true}, draws, dimension, work);
  }

 private:
  struct Edge {
    std::uint32_t number;
    bool straight;  ///< no deflection since the camera
  };

  /// Radiance along a ray, times throughput.
  Rgb follow(Ray ray, const Rgb& throughput, const Edge& edge, const PathSampler& draws, std::uint32_t& dimension,
             ScalarWork& work) const {
    Interaction at;
    const std::uint32_t edges = edge.number;
    if (!within(edges)) return Rgb(0.0f);
    const float u_layer = draws.one(dimension++);
    bool met = scene_interface_.intersect(ray, u_layer, TransportMode::radiance, at);
    if (edges == 1) {
      for (; met && is_hidden(at); met = scene_interface_.intersect(ray, u_layer, TransportMode::radiance, at))
        ray = scene_interface_.pass(ray, at, ray.direction);
      met = met && !camera_.beyond_far_plane(at.p);
    }
    if (!met)
      return edge.straight && limits_.hide_emitters ? Rgb(0.0f)
                                                    : throughput * lights_->environment_radiance(ray.direction);
    const Vec3f wo = -ray.direction;
    Rgb radiance(0.0f);
    if (at.light != no_index) radiance += throughput * lights_->radiance(at.light, lights_.point(at), wo);
    if (!within(edges + 1)) return radiance;
    if (has_smooth(at.bsdf)) radiance += throughput * direct_light(at, wo, draws, dimension, work);

    // The lobes of a BSDF share [0,1): its ends select every delta lobe that any kind has.
    std::array<Scattered, 2> lobes{scatter(at, wo, 0.0f, {0.5f, 0.5f}, TransportMode::radiance),
                                   scatter(at, wo, 1 - 0x1p-24f, {0.5f, 0.5f}, TransportMode::radiance)};
    if (lobes[0].valid && lobes[1].valid && lobes[0].delta && lobes[1].delta &&
        dot(lobes[0].wi, lobes[1].wi) > 0.999999f)
      lobes[1].valid = false;
    for (const Scattered& lobe : lobes) {
      if (!lobe.valid || !lobe.delta) continue;
      const Rgb on = throughput * lobe.weight * lobe.pdf;  // without the probability of choosing the lobe
      if (max_component(on) < faint) continue;
      ++work.rays.bounce;
      radiance += follow(scene_interface_.leave(at, lobe.wi), on, {edges + 1, edge.straight && lobe.straight}, draws,
                         dimension, work);
    }
    return radiance;
  }

  Rgb direct_light(const Interaction& at, const Vec3f& wo, const PathSampler& draws, std::uint32_t& dimension,
                   ScalarWork& work) const {
    Rgb sum(0.0f);
    for (std::uint32_t light = 0; light < lights_->count(); ++light) {
      const LightSeen seen = lights_->sample_of(light, at.p, draws.two(dimension++));
      if (!(seen.pdf > 0)) continue;
      const Rgb value = evaluate(at, wo, seen.wi, TransportMode::radiance) * seen.radiance * (1 / seen.pdf);
      if (!(max_component(value) > 0)) continue;
      ++work.rays.shadow;
      if (scene_interface_.visible(end_at(at), lights_.end(seen))) sum += value;
    }
    return sum;
  }

  int grid_;
};

}  // namespace

void plan_whitted(const IntegratorDescription& description, Planner& planner) {
  const auto& method = std::get<WhittedDescription>(description.method);
  planner.run("camera paths", "through mirrors and both ways at smooth dielectrics, " + depth_words(method.max_depth));
  planner.run("direct light", "one point of every light at every other surface; no light between those");
  planner.rays_one_by_one();
  planner.no_light_paths();
}

void render_whitted(const Scene& scene, const RenderPlan& plan, const RenderJob& job, Film& film, RenderStats& stats) {
  const WhittedTracer tracer(scene, std::get<WhittedDescription>(plan.method.method), job.grid);
  render_samples(
      scene, job, whitted_stream, "ray tracing", film, stats,
      [&](int x, int y, const PathSampler& draws, ScalarWork& work) { return tracer.sample(x, y, draws, work); });
}

}  // namespace photonproof::inline renderer_integrators
