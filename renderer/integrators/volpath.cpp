// Path tracing of the radiative transfer equation (Chandrasekhar 1960; Kajiya and Von Herzen 1984), unbiased.
// Distances are sampled from the extinction, by delta tracking where it varies (varying_medium.h). Every scattering
// samples a light through the media and null surfaces between. The power heuristic (Veach 1997) weights this against
// the lights that sampled directions meet. Homogeneous media that only absorb scale the throughput without a random
// number. As in Mitsuba's volpath, surfaces that light passes straight through are no path vertices: they add no depth,
// and light sampling passes them. The same holds for lights that are hidden from the camera, up to the first vertex.

#include "renderer/integrators/volpath.h"

#include "renderer/lanes/roulette.h"
#include "renderer/media/varying_medium.h"
#include "renderer/scalar/scalar_passes.h"
#include "renderer/scalar/scalar_tracer.h"

namespace photonproof::inline renderer_integrators {
namespace {

/// Uses of random numbers. A path's steps are its straight pieces; a light's segment has numbers of its own, far
/// beyond.
namespace volpath_dimension {
constexpr std::uint32_t in_pixel = 0, lens = 1;
constexpr std::uint32_t first_step = 4, of_step = 9;
enum What : std::uint32_t { layer, channel, distance, light_sampling, light_point, lobe, direction, roulette };
constexpr std::uint32_t at_step(std::uint32_t step, What what) { return first_step + step * of_step + what; }
constexpr std::uint32_t segment(std::uint32_t step) { return 0x80000000u + step * 1024u; }
}  // namespace volpath_dimension

float power_heuristic(float pdf, float other) {
  const float ratio = other / pdf;
  return 1 / (1 + ratio * ratio);
}

class VolumetricTracer : ScalarTracer {
 public:
  VolumetricTracer(const Scene& scene, const PathLimits& limits, int grid)
      : ScalarTracer(scene, limits, std::int64_t{scene.width} * scene.height), grid_(grid) {}

  Rgb sample(int x, int y, const PathSampler& draws, ScalarWork& work) const {
    const std::optional<Ray> first =
        camera_.ray(x, y, draws, grid_, volpath_dimension::in_pixel, draws.two(volpath_dimension::lens), work.part);
    if (!first) return Rgb(0.0f);
    Path h;
    h.ray = *first;
    bool from_camera = true;  // only hidden lights met so far
    h.surroundings = around_camera_;
    ++work.rays.camera;
    for (std::uint32_t step = 0;; ++step) {
      Interaction at;
      const bool met =
          scene_interface_.intersect(h.ray, draws.one(volpath_dimension::at_step(step, volpath_dimension::layer)),
                                     TransportMode::radiance, at) &&
          !(from_camera && camera_.beyond_far_plane(at.p));
      from_camera = from_camera && met && is_hidden(at);
      const float distance = met ? h.ray.way_to(at.p) : scene_interface_.far_away();
      const std::optional<float> scattered = cross_medium(h, distance, met, step, draws);
      if (!(max_component(h.throughput) > 0)) return h.radiance;
      const bool goes_on = scattered ? scatter_in_medium(h, *scattered, step, draws, work)
                           : met     ? meet_surface(h, at, step, draws, work)
                                     : meet_environment(h);
      if (!goes_on) return h.radiance;
      ++work.rays.bounce;
    }
  }

 private:
  struct Path {
    Ray ray;
    Surroundings surroundings;
    Rgb throughput{1, 1, 1}, radiance{0, 0, 0};
    float refraction_scale = 1;  ///< Undoes the squared index ratios in the throughput, for roulette.
    std::uint32_t depth = 0;     ///< Number of scatterings so far.
    Vec3f scattered_at;          ///< Position of the last scattering.
    float pdf = 0;               ///< Density of its sampled direction; 0 where light sampling had no part in it.
  };

  /// Applies the medium's transmittance to the throughput. Returns a distance where the path scatters in the medium.
  std::optional<float> cross_medium(Path& h, float distance, bool met, std::uint32_t step,
                                    const PathSampler& draws) const {
    if (h.surroundings.medium() == no_index) return std::nullopt;
    const Medium& medium = scene_interface_.scene().media.media[h.surroundings.medium()];
    if (!met) distance = std::numeric_limits<float>::infinity();
    if (!medium.scatters && !medium.varying) {
      h.throughput *= medium.transmittance(distance);
      return std::nullopt;
    }
    const std::uint32_t at_distance = volpath_dimension::at_step(step, volpath_dimension::distance);
    const FreeFlight flight =
        medium.varying
            ? medium.varying->fly(h.throughput, h.ray.start(), h.ray.direction, distance,
                                  draws_of_flight(draws, at_distance))
            : fly(medium, h.throughput, h.ray.start(), h.ray.direction, distance,
                  draws.one(volpath_dimension::at_step(step, volpath_dimension::channel)), draws.one(at_distance));
    h.throughput *= flight.weight;
    return flight.scattered;
  }

  bool scatter_in_medium(Path& h, float distance, std::uint32_t step, const PathSampler& draws,
                         ScalarWork& work) const {
    if (!within(h.depth + 2)) return false;
    const Vec3f p = h.ray.origin + h.ray.direction * (distance - h.ray.gap);
    const PhaseFunction phase = scene_interface_.scene().media.media[h.surroundings.medium()].phase_at(p);
    const LightSeen seen = light_seen(p, step, draws);
    if (seen.pdf > 0) {
      const float f = phase.eval(h.ray.direction, seen.wi);
      const float weight = seen.is_delta ? 1.0f : power_heuristic(seen.pdf, f);
      ++work.rays.shadow;
      h.radiance += h.throughput * seen.radiance * (f * weight / seen.pdf) *
                    transmittance(scene_interface_, {p}, lights_.end(seen), h.surroundings, {.null = true}, draws,
                                  volpath_dimension::segment(step));
    }
    const Vec3f wi =
        phase.sample(h.ray.direction, draws.two(volpath_dimension::at_step(step, volpath_dimension::direction)));
    h.pdf = phase.eval(h.ray.direction, wi);
    h.scattered_at = p;
    h.ray = {p, wi};
    ++h.depth;
    return survives(h, step, draws);
  }

  bool meet_surface(Path& h, Interaction& at, std::uint32_t step, const PathSampler& draws, ScalarWork& work) const {
    const Vec3f wo = -h.ray.direction;
    const bool is_passed = h.depth == 0 && is_hidden(at);
    if (at.light != no_index && !is_passed) add_emission(h, at, wo);
    const Crossing crossing = h.surroundings.crossing(scene_interface_, at, h.ray.direction);
    if (is_passed || !crossing.is_boundary) {
      h.surroundings.cross(scene_interface_, at, h.ray.direction);
      h.ray = scene_interface_.pass(h.ray, at, h.ray.direction);
      return true;
    }
    Surroundings::refract_as(crossing, at);
    if (has_smooth(at.bsdf) && within(h.depth + 2)) add_direct_light(h, at, wo, step, draws, work);
    const Scattered next =
        scatter(at, wo, draws.one(volpath_dimension::at_step(step, volpath_dimension::lobe)),
                draws.two(volpath_dimension::at_step(step, volpath_dimension::direction)), TransportMode::radiance);
    if (!next.valid) return false;
    h.throughput *= next.weight;
    h.refraction_scale *= next.eta * next.eta;
    h.surroundings.leave(scene_interface_, at, wo, next.wi);
    h.ray = next.straight ? scene_interface_.pass(h.ray, at, next.wi) : scene_interface_.leave(at, next.wi);
    if (next.straight) return true;
    h.pdf = next.delta ? 0.0f : next.pdf;
    h.scattered_at = at.p;
    ++h.depth;
    return within(h.depth + 1) && survives(h, step, draws);
  }

  void add_emission(Path& h, const Interaction& at, const Vec3f& wo) const {
    const LightPoint<float> point = lights_.point(at);
    const Rgb emitted = lights_->radiance(at.light, point, wo);
    if (!(max_component(emitted) > 0)) return;
    const float weight = h.pdf > 0 ? power_heuristic(h.pdf, lights_->pdf(at.light, h.scattered_at, point)) : 1.0f;
    h.radiance += h.throughput * emitted * weight;
  }

  /// Adds the environment's radiance; the path ends.
  bool meet_environment(Path& h) const {
    if (!lights_->environment() || (h.depth == 0 && limits_.hide_emitters)) return false;
    const Vec3f& direction = h.ray.direction;
    const float weight = h.pdf > 0 ? power_heuristic(h.pdf, lights_->environment_pdf(h.scattered_at, direction)) : 1.0f;
    h.radiance += h.throughput * lights_->environment_radiance(direction) * weight;
    return false;
  }

  LightSeen light_seen(const Vec3f& p, std::uint32_t step, const PathSampler& draws) const {
    return lights_->sample(p, draws.one(volpath_dimension::at_step(step, volpath_dimension::light_sampling)),
                           draws.two(volpath_dimension::at_step(step, volpath_dimension::light_point)));
  }

  void add_direct_light(Path& h, const Interaction& at, const Vec3f& wo, std::uint32_t step, const PathSampler& draws,
                        ScalarWork& work) const {
    const LightSeen seen = light_seen(at.p, step, draws);
    if (!(seen.pdf > 0)) return;
    const Rgb f = evaluate(at, wo, seen.wi, TransportMode::radiance);
    if (!(max_component(f) > 0)) return;
    const float weight =
        seen.is_delta ? 1.0f : power_heuristic(seen.pdf, scatter_pdf(at, wo, seen.wi, TransportMode::radiance));
    Surroundings outward = h.surroundings;
    outward.leave(scene_interface_, at, wo, seen.wi);
    ++work.rays.shadow;
    h.radiance += h.throughput * f * seen.radiance * (weight / seen.pdf) *
                  transmittance(scene_interface_, end_at(at), lights_.end(seen), outward, {.null = true}, draws,
                                volpath_dimension::segment(step));
  }

  /// Russian roulette from rr_depth on, with the largest channel.
  bool survives(Path& h, std::uint32_t step, const PathSampler& draws) const {
    if (!(max_component(h.throughput) > 0)) return false;
    if (h.depth < static_cast<std::uint32_t>(limits_.rr_depth)) return true;
    const float q = survival_probability(max_component(h.throughput) * h.refraction_scale, h.depth, limits_.rr_depth);
    if (draws.one(volpath_dimension::at_step(step, volpath_dimension::roulette)) >= q) return false;
    h.throughput *= 1 / q;
    return true;
  }

  int grid_;
};

}  // namespace

void plan_volpath(const IntegratorDescription& description, Planner& planner) {
  const auto& method = std::get<VolPathDescription>(description.method);
  planner.run("camera paths", depth_words(method.max_depth) + ", one at a time, roulette from depth " +
                                  std::to_string(method.rr_depth));
  planner.run("media", planner.facts().media == 0 ? "none" : counted(planner.facts().media, "medium", "media"));
  planner.rays_one_by_one();
  planner.no_light_paths();
}

void render_volpath(const Scene& scene, const RenderPlan& plan, const RenderJob& job, Film& film, RenderStats& stats) {
  const VolumetricTracer tracer(scene, std::get<VolPathDescription>(plan.method.method), job.grid);
  render_samples(
      scene, job, volpath_stream, "volumetric path tracing", film, stats,
      [&](int x, int y, const PathSampler& draws, ScalarWork& work) { return tracer.sample(x, y, draws, work); });
}

}  // namespace photonproof::inline renderer_integrators
