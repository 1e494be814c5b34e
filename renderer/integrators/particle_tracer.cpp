// Light tracing (Arvo 1986; Dutre, Lafortune, Willems 1993). Paths start at the lights, in proportion to their flux.
// Every vertex that scatters into more than single directions is connected to the camera. There are N paths and an
// image of P pixels. A vertex of throughput b adds to the pixel that it is seen in
//   `P/N b f |cos| q V`.
// The factor q is the density, over the whole image, with which camera rays would have ended there
// (CameraSeen::density): a pixel measures the mean over its own camera rays. Light from infinity that meets nothing has
// no vertex to connect; one camera ray a sample shows it.

#include "renderer/integrators/particle_tracer.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include "renderer/lanes/roulette.h"
#include "renderer/scalar/scalar_passes.h"
#include "renderer/scalar/scalar_tracer.h"

namespace photonproof::inline renderer_integrators {
namespace {

/// Uses of a path's random numbers.
namespace ptracer_dimension {
constexpr std::uint32_t light = 0, position = 1, direction = 2, seen_light = 3, seen_position = 4, seen_lens = 5;
constexpr std::uint32_t segment = 0x80000000u;
constexpr std::uint32_t in_pixel = 0, lens = 1, layer = 2;  // for the camera's ray, which has a sequence of its own
constexpr std::uint32_t first_vertex = 8, of_vertex = 5;    // from there: lens, direction, lobe, roulette, layer
constexpr std::uint32_t at_vertex(std::uint32_t vertex, std::uint32_t what) {
  return first_vertex + vertex * of_vertex + what;
}
}  // namespace ptracer_dimension

class ParticleTracer : ScalarTracer {
 public:
  ParticleTracer(const Scene& scene, const PathLimits& limits, std::int64_t pixels)
      : ScalarTracer(scene, limits, pixels) {}

  void trace(const PathSampler& draws, ScalarWork& work) const {
    if (lights_->count() == 0) return;
    if (!limits_.hide_emitters) show_light(draws, work);
    const LightStart start = lights_->emit(draws.one(ptracer_dimension::light), draws.two(ptracer_dimension::position),
                                           draws.two(ptracer_dimension::direction));
    Rgb throughput = start.flux * arriving_from_infinity(scene_interface_, start.is_outside, outer_);
    if (!(max_component(throughput) > 0)) return;
    const Rgb first_throughput = throughput;
    Ray ray = first_ray(start);
    Surroundings around = surroundings_at(scene_interface_, start.at.p, outer_);
    ++work.rays.photon;
    // The number `edges` is that from the light to the vertex; the edge to the camera is additional.
    for (std::uint32_t edges = 1; within(edges + 1); ++edges) {
      const auto draw = [&](std::uint32_t what) { return ptracer_dimension::at_vertex(edges, what); };
      Interaction at;
      if (!travel(scene_interface_, ray, around, draws.one(draw(4)), TransportMode::importance, throughput, at)) return;
      const Vec3f to_light = -ray.direction;
      if (has_smooth(at.bsdf) && !is_hidden(at)) connect(at, to_light, throughput, around, draws, draw(0), work);
      if (!within(edges + 2)) return;
      const Scattered next = scatter(at, to_light, draws.one(draw(2)), draws.two(draw(1)), TransportMode::importance);
      if (!next.valid) return;
      throughput *= next.weight;
      if (!(max_component(throughput) > 0)) return;
      if (edges >= static_cast<std::uint32_t>(limits_.rr_depth)) {
        const float q =
            survival_probability(max_component(throughput) / max_component(first_throughput), edges, limits_.rr_depth);
        if (draws.one(draw(3)) >= q) return;
        throughput *= 1 / q;
      }
      around.leave(scene_interface_, at, to_light, next.wi);
      ray = scene_interface_.leave(at, next.wi);
      ++work.rays.bounce;
    }
  }

  /// Radiance of the environment that the camera sees directly.
  Rgb environment(int x, int y, const PathSampler& draws, ScalarWork& work) const {
    if (!lights_->environment() || limits_.hide_emitters || !within(1)) return Rgb(0.0f);
    std::optional<Ray> ray =
        camera_.ray(x, y, draws, 0, ptracer_dimension::in_pixel, draws.two(ptracer_dimension::lens), work.part);
    if (!ray) return Rgb(0.0f);
    ++work.rays.camera;
    Rgb throughput(1.0f);
    Surroundings around = around_camera_;
    Interaction at;
    if (look(*ray, around, draws.one(ptracer_dimension::layer), throughput, at)) return Rgb(0.0f);
    return throughput * lights_->environment_radiance(ray->direction);
  }

  /// Whether the middle of a pixel shows a surface, rather than the environment or nothing.
  bool shows_surface(int x, int y, const PathSampler& draws) const {
    constexpr int at_the_middle = 1;
    const std::optional<Ray> ray =
        camera_.ray(x, y, draws, at_the_middle, ptracer_dimension::in_pixel, draws.two(ptracer_dimension::lens));
    Interaction at;
    return ray && scene_interface_.intersect(*ray, draws.one(ptracer_dimension::layer), TransportMode::radiance, at) &&
           !camera_.beyond_far_plane(at.p);
  }

  /// Whether a pixel shows so small an area that a black value may be chance. True where a pixel as bright as
  /// `radiance` would receive fewer than `paths` paths, at `light_paths` paths a pixel.
  bool is_narrow(int x, int y, double radiance, double light_paths, double paths, const PathSampler& draws) const {
    constexpr int at_the_middle = 1;
    const Vec2<float> lens = draws.two(ptracer_dimension::lens);
    std::optional<Ray> ray = camera_.ray(x, y, draws, at_the_middle, ptracer_dimension::in_pixel, lens);
    Rgb throughput(1.0f);
    Surroundings around = around_camera_;
    Interaction at;
    if (!ray || !look(*ray, around, draws.one(ptracer_dimension::layer), throughput, at)) return false;
    const std::optional<CameraSeen> seen = camera_.connect(at.p, lens);
    if (!seen || !has_smooth(at.bsdf)) return false;
    const Vec3f above = std::copysign(1.0f, dot(at.ng, seen->wi)) * at.ng;
    const LightStart start = lights_->emit(draws.one(ptracer_dimension::light), draws.two(ptracer_dimension::position),
                                           draws.two(ptracer_dimension::direction));
    const double arrives =
        double{max_component(start.flux * evaluate(at, seen->wi, above, TransportMode::importance))} *
        double{seen->density};
    return arrives > 0 && radiance * light_paths < paths * arrives;
  }

 private:
  void connect(const Interaction& at, const Vec3f& to_light, const Rgb& throughput, Surroundings around,
               const PathSampler& draws, std::uint32_t lens, ScalarWork& work) const {
    const std::optional<CameraSeen> seen = camera_.connect(at.p, draws.two(lens));
    if (!seen) return;
    Interaction other;
    const Rgb f =
        evaluate(scene_interface_.seen_from(at, seen->wi, other), seen->wi, to_light, TransportMode::importance);
    const Rgb value = throughput * f * seen->density;
    around.leave(scene_interface_, at, to_light, seen->wi);
    add(value, end_at(at), *seen, around, draws, work);
  }

  /// Shows the light itself, by a separately sampled point on it.
  void show_light(const PathSampler& draws, ScalarWork& work) const {
    const LightStart start =
        lights_->emit(draws.one(ptracer_dimension::seen_light), draws.two(ptracer_dimension::seen_position),
                      draws.two(ptracer_dimension::direction));
    if (start.is_delta || start.is_infinite || !(start.pdfs.first > 0)) return;
    const std::optional<CameraSeen> seen = camera_.connect(start.at.p, draws.two(ptracer_dimension::seen_lens));
    if (!seen) return;
    const Rgb emitted = lights_->radiance(start.light, start.at, seen->wi);
    add(emitted * (cosine(start.at.normal, seen->wi) * seen->density / start.pdfs.first), lights_.end(start), *seen,
        surroundings_at(scene_interface_, start.at.p, outer_), draws, work);
  }

  void add(const Rgb& value, const SegmentEnd& from, const CameraSeen& seen, const Surroundings& around,
           const PathSampler& draws, ScalarWork& work) const {
    if (!(max_component(value) > 0)) return;
    ++work.rays.shadow;
    const Rgb arrives = value * arriving_at_camera(from, seen.end, around, draws, ptracer_dimension::segment);
    if (max_component(arrives) > 0) work.splats.push_back({seen.raster, arrives});
  }
};

constexpr const char* light_paths_miss_planes =
    "light paths miss a plane without end, from afar, where light from infinity falls on it: it is too dark there";

/// Minimum of paths a pixel, averaged over the pixels that any path reaches. With fewer, unreached pixels are
/// inconclusive.
constexpr double few_paths_a_pixel = 8;

std::string few_paths_text(const char* format, double paths, std::size_t pixels) {
  char text[240];
  std::snprintf(text, sizeof text, format, paths, pixels);
  return text;
}

/// Adds a warning where too few paths may reach the image. That is the case for a distant light or a view of a tiny
/// part of the scene. It is also the case for pixels at the edge of a very wide view, which show tiny areas.
void say_if_few_arrive(const Scene& scene, const ParticleTracer& tracer, const RenderJob& job, const Film& film,
                       RenderStats& stats) {
  if (scene.lights.empty()) return;
  const Image image = film.develop().mean;
  std::size_t wanted = 0, reached = 0;  // pixels that show surfaces, and the non-black ones among them
  double brightness = 0;
  const auto brightest = [&](std::size_t pixel) {
    const float* rgb = &image.rgb[3 * pixel];
    return double{std::max({rgb[0], rgb[1], rgb[2]})};
  };
  const auto at = [&](std::size_t i) {
    const auto width = static_cast<std::size_t>(image.width);
    return std::pair{film.window().x0 + static_cast<int>(i % width), film.window().y0 + static_cast<int>(i / width)};
  };
  const auto draws_at = [&](std::size_t i) {
    return sampler_of_path(SamplerKind::independent, job.seed, ptracer_stream, i);
  };
  for (std::size_t i = 0; i < image.pixels(); ++i) {
    if (!tracer.shows_surface(at(i).first, at(i).second, draws_at(i))) continue;
    ++wanted;
    reached += brightest(i) > 0 ? 1 : 0;
    brightness += brightest(i);
  }
  if (wanted == 0) return;
  if (reached == 0) {
    stats.losses.emplace_back(
        "no light path arrived where the camera looks: the image is black, and so few paths may miss light that is "
        "there");
    return;
  }
  brightness /= static_cast<double>(reached);
  if (const double joined = stats.counts["rays_shadow"] / static_cast<double>(reached); joined < few_paths_a_pixel) {
    stats.losses.push_back(few_paths_text(
        "%.2g light paths arrived in each of the %zu pixels that any reached: too few to know the error of the others",
        joined, reached));
    return;
  }
  std::size_t narrow = 0;
  for (std::size_t i = 0; i < image.pixels(); ++i) {
    if (brightest(i) > 0) continue;
    const auto [x, y] = at(i);
    if (tracer.is_narrow(x, y, brightness, stats.counts["samples_per_pixel"], few_paths_a_pixel, draws_at(i))) ++narrow;
  }
  if (narrow > 0)
    stats.losses.push_back(
        few_paths_text("fewer than %.2g light paths would arrive in each of %zu black pixels if they were as bright as "
                       "the others: they may be dark by chance",
                       few_paths_a_pixel, narrow));
}

}  // namespace

void plan_particle_tracer(const IntegratorDescription& description, Planner& planner) {
  const auto& method = std::get<ParticleTracerDescription>(description.method);
  planner.run("light paths", depth_words(method.max_depth) + ", one a camera sample, each vertex joined to the lens");
  planner.rays_one_by_one();
}

void render_particle_tracer(const Scene& scene, const RenderPlan& plan, const RenderJob& job, Film& film,
                            RenderStats& stats) {
  const auto pixels = static_cast<std::uint64_t>(film.width()) * static_cast<std::uint64_t>(film.height());
  const ParticleTracer tracer(scene, std::get<ParticleTracerDescription>(plan.method.method),
                              static_cast<std::int64_t>(pixels));
  render_splats(scene, job, ptracer_stream, "light tracing", film, stats, [&] {
    return [&](int x, int y, const PathSampler& draws, ScalarWork& work) {
      const auto pixel = static_cast<std::uint64_t>(y - film.window().y0) * static_cast<std::uint64_t>(film.width()) +
                         static_cast<std::uint64_t>(x - film.window().x0);
      if (work.part == FilterPart::positive)
        tracer.trace(sampler_of_path(job.sampler, job.seed, ptracer_stream, draws.index * pixels + pixel), work);
      return tracer.environment(x, y, draws, work);
    };
  });
  say_if_few_arrive(scene, tracer, job, film, stats);
  if (emission_misses_planes(scene.surfaces, scene.lights)) stats.losses.emplace_back(light_paths_miss_planes);
}

}  // namespace photonproof::inline renderer_integrators
