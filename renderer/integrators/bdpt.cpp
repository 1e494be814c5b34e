// Bidirectional path tracing (Veach 1997, chapter 10; Lafortune and Willems 1993). Each camera sample has a light path
// of its own, and every vertex of one path is joined to every vertex of the other. The strategies are: camera path
// meets a light (s = 0), next-event estimation (s = 1), light vertex to lens (t = 1), vertex to vertex. bdpt_weights.h
// weights them. Contributions at the lens are splatted. In rooms that absorb hardly any light, paths have thousands of
// vertices. Late vertices of a camera path are therefore joined to one light vertex each, drawn uniformly and counted
// for all.

#include "renderer/integrators/bdpt.h"

#include "renderer/integrators/bdpt_weights.h"
#include "renderer/integrators/particle_tracer.h"
#include "renderer/lanes/roulette.h"
#include "renderer/scalar/scalar_passes.h"
#include "renderer/scalar/scalar_tracer.h"

namespace photonproof::inline renderer_integrators {
namespace {

/// A vertex of either subpath that can be joined to others.
struct Vertex {
  Interaction at;
  Vec3f back;      ///< Unit direction to the vertex before.
  Rgb throughput;  ///< Throughput of the subpath up to here, over its densities.
  SubpathWeights weights;
  Surroundings around;         ///< Surroundings on the side of `back`.
  std::uint32_t edges;         ///< Number of edges of the subpath.
  float refraction_scale = 1;  ///< Undoes the squared index ratios in the throughput, for roulette.
  bool went_straight = false;  ///< True if the path went straight on from here.
};

/// Camera vertices after at most so many edges are joined to every light vertex.
constexpr std::uint32_t joined_to_all = 16;

/// Uses of a path's random numbers; light paths and camera paths have sequences of their own.
namespace bdpt_dimension {
constexpr std::uint32_t in_pixel = 0, lens = 1;
constexpr std::uint32_t light = 0, position = 1, direction = 2;
constexpr std::uint32_t first_vertex = 4, of_vertex = 6;
constexpr std::uint32_t joined = 0x40000000u, segment = 0x80000000u;
enum What : std::uint32_t { next, lobe, roulette, layer, end_choice, end_point };
constexpr std::uint32_t at_vertex(std::uint32_t edges, What what) { return first_vertex + edges * of_vertex + what; }
}  // namespace bdpt_dimension

class BidirectionalTracer : ScalarTracer {
 public:
  BidirectionalTracer(const Scene& scene, const PathLimits& limits, int grid, std::int64_t pixels)
      : ScalarTracer(scene, limits, pixels), grid_(grid) {}

  /// Radiance of a camera sample. Its light path's contributions at the lens are splatted. `light_path` is scratch.
  Rgb sample(int x, int y, const PathSampler& camera_sampler, const PathSampler& light_sampler,
             std::vector<Vertex>& light_path, ScalarWork& work) const {
    light_path.clear();
    if (lights_->count() > 0) trace_light_path(light_sampler, light_path, work);
    return trace_camera_path(x, y, camera_sampler, light_path, work);
  }

 private:
  void trace_light_path(const PathSampler& draws, std::vector<Vertex>& path, ScalarWork& work) const {
    if (!within(2)) return;
    const LightStart start = lights_->emit(draws.one(bdpt_dimension::light), draws.two(bdpt_dimension::position),
                                           draws.two(bdpt_dimension::direction));
    // Along the light's own surface the density is 0; rounding produces this once in some ten million paths.
    if (!(max_component(start.flux) > 0 && start.pdfs.second > 0 && start.pdfs.first > 0)) return;
    Ray ray = first_ray(start);
    ++work.rays.photon;
    Vertex v;
    v.throughput = start.flux * arriving_from_infinity(scene_interface_, start.is_outside, outer_);
    if (!(max_component(v.throughput) > 0)) return;
    if (scene_interface_.has_media_or_interiors()) v.around = surroundings_at(scene_interface_, start.at.p, outer_);
    for (v.edges = 1;; ++v.edges) {
      // One more edge leads to the lens.
      const Vec3f before = ray.origin;
      if (!within(v.edges + 1) || !meet(ray, draws, TransportMode::importance, v) || !has_density(v, before)) return;
      if (v.edges == 1)
        v.weights = first_light_weights(start, v.at);
      else
        v.weights.arrive(length_squared(v.at.p - before), cosine(v.at.ng, v.back));
      if (has_smooth(v.at.bsdf)) {
        join_lens(v, draws, work);
        path.push_back(v);
      }
      if (!within(v.edges + 2) || !go_on(v, draws, TransportMode::importance, max_component(start.flux), ray)) return;
      ++work.rays.bounce;
    }
  }

  Rgb trace_camera_path(int x, int y, const PathSampler& draws, const std::vector<Vertex>& light_path,
                        ScalarWork& work) const {
    const Vec2<float> u_lens = draws.two(bdpt_dimension::lens);
    std::optional<Ray> first = camera_.ray(x, y, draws, grid_, bdpt_dimension::in_pixel, u_lens, work.part);
    if (!first) return Rgb(0.0f);
    Ray& ray = *first;
    ++work.rays.camera;
    Rgb radiance(0.0f);
    Vertex v;
    v.throughput = Rgb(1.0f);
    v.around = around_camera_;
    bool shows_environment = !limits_.hide_emitters;
    for (v.edges = 1;; ++v.edges) {
      const Vec3f before = ray.origin;
      if (!within(v.edges)) return radiance;
      if (!meet(ray, draws, TransportMode::radiance, v))
        return lights_->environment() && shows_environment ? radiance + meet_environment(v, before) : radiance;
      if (!has_density(v, before)) return radiance;
      if (v.edges == 1) {
        const double density = camera_.density(v.at.p, u_lens) * cosine(v.at.ng, v.back);
        if (density > 0) v.weights = {1 / (density * density), 0};
      } else {
        v.weights.arrive(length_squared(v.at.p - before), cosine(v.at.ng, v.back));
      }
      if (v.at.light != no_index) radiance += meet_light(v, before);
      if (!within(v.edges + 1)) return radiance;
      if (has_smooth(v.at.bsdf)) {
        radiance += join_light(v, draws, work);
        radiance += join_light_path(v, light_path, draws, work);
      }
      if (!go_on(v, draws, TransportMode::radiance, 1, ray)) return radiance;
      shows_environment = shows_environment || !v.went_straight;
      ++work.rays.bounce;
    }
  }

  bool meet(Ray& ray, const PathSampler& draws, TransportMode mode, Vertex& v) const {
    v.back = -ray.direction;
    const float u_layer = draws.one(bdpt_dimension::at_vertex(v.edges, bdpt_dimension::layer));
    if (mode == TransportMode::radiance && v.edges == 1) return look(ray, v.around, u_layer, v.throughput, v.at);
    return travel(scene_interface_, ray, v.around, u_layer, mode, v.throughput, v.at);
  }

  /// False where a ray meets a surface edge-on or at its own start: no density per area exists. Such rays contribute to
  /// no image.
  static bool has_density(const Vertex& v, const Vec3f& before) {
    return cosine(v.at.ng, v.back) > 0 && length_squared(v.at.p - before) > 0;
  }

  /// Share of the light that passes between the vertex and another point.
  Rgb arriving(const Vertex& v, const SegmentEnd& to, const PathSampler& draws) const {
    if (!scene_interface_.has_media_or_interiors())
      return Rgb(scene_interface_.visible(end_at(v.at), to) ? 1.0f : 0.0f);
    return transmittance(scene_interface_, end_at(v.at), to, towards(v, to), {}, draws, bdpt_dimension::segment);
  }
  Surroundings towards(const Vertex& v, const SegmentEnd& to) const {
    Surroundings around = v.around;
    if (scene_interface_.has_media_or_interiors()) around.leave(scene_interface_, v.at, v.back, to.p - v.at.p);
    return around;
  }

  /// Density with which a light path would continue from the vertex along the camera path.
  static float light_pdf(const Vertex& v, const Vec3f& from_light) {
    return light_goes_on * scatter_pdf(v.at, from_light, v.back, TransportMode::importance);
  }

  /// Samples the next direction and applies roulette; false where the subpath ends. `full` is the throughput that
  /// roulette compares with.
  bool go_on(Vertex& v, const PathSampler& draws, TransportMode mode, float full, Ray& ray) const {
    const Scattered next = scatter(v.at, v.back, draws.one(bdpt_dimension::at_vertex(v.edges, bdpt_dimension::lobe)),
                                   draws.two(bdpt_dimension::at_vertex(v.edges, bdpt_dimension::next)), mode);
    if (!next.valid) return false;
    v.went_straight = next.straight;
    const bool from_light = mode == TransportMode::importance;
    const float cos_out = cosine(v.at.ng, next.wi);
    if (next.delta)
      v.weights.scatter_delta(from_light ? 1 / light_goes_on : light_goes_on, cos_out);
    else if (from_light)
      v.weights.scatter(light_goes_on * next.pdf, scatter_pdf(v.at, next.wi, v.back, TransportMode::radiance), cos_out);
    else
      v.weights.scatter(next.pdf, light_pdf(v, next.wi), cos_out);
    v.throughput *= next.weight;
    if (!from_light) v.refraction_scale *= next.eta * next.eta;
    if (!(max_component(v.throughput) > 0)) return false;
    if (v.edges >= static_cast<std::uint32_t>(limits_.rr_depth)) {
      const float weight = max_component(v.throughput) * v.refraction_scale / full;
      const float q =
          from_light ? std::min(light_goes_on, weight) : survival_probability(weight, v.edges, limits_.rr_depth);
      if (draws.one(bdpt_dimension::at_vertex(v.edges, bdpt_dimension::roulette)) >= q) return false;
      v.throughput *= 1 / q;
    }
    if (scene_interface_.has_media_or_interiors()) v.around.leave(scene_interface_, v.at, v.back, next.wi);
    ray = scene_interface_.leave(v.at, next.wi);
    return true;
  }

  /// Density per area at `at` of a light path's first step there.
  static float first_step(const EmissionPdfs<float>& pdfs, bool infinite, const Vec3f& start, const Interaction& at,
                          const Vec3f& to_light) {
    const float cos_in = cosine(at.ng, to_light);
    return pdfs.second * (infinite ? cos_in : cos_in / length_squared(at.p - start));
  }

  SubpathWeights first_light_weights(const LightStart& start, const Interaction& at) const {
    const Vec3f to_light = -start.direction;
    const double f0 = start.pdfs.first;
    const double f1 = light_goes_on * first_step(start.pdfs, start.is_infinite, start.at.p, at, to_light);
    const double drawn_anew = lights_->pdf(at.p, start);
    if (start.is_delta) {  // no camera path meets it
      const double a = drawn_anew / (f0 * f1);
      return {a * a, 0};
    }
    const double g0 = start.is_infinite ? 1.0f : cosine(start.at.normal, to_light) / length_squared(at.p - start.at.p);
    const double a = g0 * drawn_anew / (f0 * f1), b = g0 / (f0 * f1);
    return {a * a, b * b};
  }

  /// Density with which light paths start at the light's point and direction, times that of continuing.
  static double emitting(const EmissionPdfs<float>& pdfs) {
    return double{light_goes_on} * double{pdfs.first} * double{pdfs.second};
  }

  /// Strategy s = 0: the camera path meets a light.
  Rgb meet_light(const Vertex& v, const Vec3f& before) const {
    const LightPoint<float> point = lights_.point(v.at);
    const Rgb emitted = lights_->radiance(v.at.light, point, v.back);
    if (!(max_component(emitted) > 0)) return Rgb(0.0f);
    if (v.edges == 1) return v.throughput * emitted;
    const EmissionPdfs<float> pdfs = lights_->emit_pdfs(v.at.light, point, v.back, before);
    const double g = cosine(v.at.ng, v.back) / length_squared(v.at.p - before);
    const double drawn_anew = g * lights_->pdf(v.at.light, before, point);
    // This is (d_0/b_0)^2 for s = 1; for s > 1 the previous sum times (f_0 t_0/b_0 ...)^2.
    const double more = v.weights.ratio_of_light(drawn_anew, emitting(pdfs));
    return v.throughput * emitted * static_cast<float>(1 / (1 + more));
  }

  /// Strategy s = 0 at infinity: the direction takes the place of the light's point, and densities stay per solid
  /// angle.
  Rgb meet_environment(const Vertex& v, const Vec3f& before) const {
    const Vec3f direction = -v.back;
    const Rgb emitted = v.throughput * lights_->environment_radiance(direction);
    if (v.edges == 1 || !(max_component(emitted) > 0)) return emitted;
    const EmissionPdfs<float> pdfs = lights_->emit_pdfs(*lights_->environment(), {before}, v.back);
    const double more = v.weights.ratio_of_light(lights_->environment_pdf(before, direction), emitting(pdfs));
    return emitted * static_cast<float>(1 / (1 + more));
  }

  /// Strategy s = 1: a point on a light is sampled for this vertex.
  Rgb join_light(const Vertex& v, const PathSampler& draws, ScalarWork& work) const {
    const LightSeen seen =
        lights_->sample(v.at.p, draws.one(bdpt_dimension::at_vertex(v.edges, bdpt_dimension::end_choice)),
                        draws.two(bdpt_dimension::at_vertex(v.edges, bdpt_dimension::end_point)));
    if (!(seen.pdf > 0)) return Rgb(0.0f);
    const Rgb f = evaluate(v.at, v.back, seen.wi, TransportMode::radiance);
    const Rgb value = v.throughput * f * seen.radiance * (1 / seen.pdf);
    if (!(max_component(value) > 0)) return Rgb(0.0f);
    ++work.rays.shadow;
    const Rgb arrives = arriving(v, lights_.end(seen), draws);
    if (!(max_component(arrives) > 0)) return Rgb(0.0f);

    const double less =
        seen.is_delta ? 0.0 : scatter_pdf(v.at, v.back, seen.wi, TransportMode::radiance) / double{seen.pdf};
    const EmissionPdfs<float> pdfs = lights_->emit_pdfs(seen.light, seen.at, -seen.wi, v.at.p);
    const double f1 = light_goes_on * first_step(pdfs, seen.is_infinite, seen.at.p, v.at, seen.wi);
    // The ratio f_0 / d_0: both per area, or per direction at an infinite light, or of the choice alone.
    double drawn = seen.pdf;
    if (!seen.is_delta && !seen.is_infinite)
      drawn *= cosine(seen.at.normal, seen.wi) / length_squared(v.at.p - seen.at.p);
    const double more = v.weights.ratio(pdfs.first * f1 / drawn, light_pdf(v, seen.wi));
    return value * arrives * static_cast<float>(1 / (1 + less * less + more));
  }

  /// Strategy t = 1: connects a light vertex to the camera.
  void join_lens(const Vertex& v, const PathSampler& draws, ScalarWork& work) const {
    if (is_hidden(v.at)) return;
    const std::optional<CameraSeen> seen =
        camera_.connect(v.at.p, draws.two(bdpt_dimension::at_vertex(v.edges, bdpt_dimension::end_point)));
    if (!seen) return;
    Interaction other;
    const Interaction& at = scene_interface_.seen_from(v.at, seen->wi, other);
    const Rgb value = v.throughput * evaluate(at, seen->wi, v.back, TransportMode::importance) * seen->density;
    if (!(max_component(value) > 0)) return;
    ++work.rays.shadow;
    const Rgb arrives =
        arriving_at_camera(end_at(v.at), seen->end, towards(v, seen->end), draws, bdpt_dimension::segment);
    if (!(max_component(arrives) > 0)) return;
    const double made = seen->density * cosine(v.at.ng, seen->wi);
    const double less = v.weights.ratio(made, scatter_pdf(at, seen->wi, v.back, TransportMode::radiance));
    work.splats.push_back({seen->raster, value * arrives * static_cast<float>(1 / (1 + less))});
  }

  /// Joins a camera vertex to the light vertices within the depth limit, which are the first ones of the light path.
  Rgb join_light_path(const Vertex& c, const std::vector<Vertex>& light_path, const PathSampler& draws,
                      ScalarWork& work) const {
    std::size_t count = light_path.size();
    while (count > 0 && !within(c.edges + light_path[count - 1].edges + 1)) --count;
    Rgb sum(0.0f);
    if (c.edges > joined_to_all) {
      if (count == 0) return sum;
      const auto n = static_cast<float>(count);
      const float u = draws.one(bdpt_dimension::joined + c.edges);
      const std::size_t drawn = std::min(count - 1, static_cast<std::size_t>(u * n));
      return join(c, light_path[drawn], draws, work) * n;
    }
    for (std::size_t i = 0; i < count; ++i) sum += join(c, light_path[i], draws, work);
    return sum;
  }

  /// Joins a camera vertex and a light vertex.
  Rgb join(const Vertex& c, const Vertex& l, const PathSampler& draws, ScalarWork& work) const {
    const Vec3f d = l.at.p - c.at.p;
    const float distance2 = length_squared(d);
    if (!(distance2 > 0)) return Rgb(0.0f);
    const Vec3f to_light = d / std::sqrt(distance2);
    const Rgb f_camera = evaluate(c.at, c.back, to_light, TransportMode::radiance);
    if (!(max_component(f_camera) > 0)) return Rgb(0.0f);
    Interaction other;
    const Interaction& at_light = scene_interface_.seen_from(l.at, -to_light, other);
    const Rgb f_light = evaluate(at_light, -to_light, l.back, TransportMode::importance);
    const Rgb value = c.throughput * f_camera * f_light * l.throughput * (1 / distance2);
    if (!(max_component(value) > 0)) return Rgb(0.0f);
    ++work.rays.shadow;
    const Rgb arrives = arriving(c, end_at(l.at), draws);
    if (!(max_component(arrives) > 0)) return Rgb(0.0f);
    const double made_by_camera =
        scatter_pdf(c.at, c.back, to_light, TransportMode::radiance) * cosine(l.at.ng, to_light) / distance2;
    const double made_by_light = light_goes_on * scatter_pdf(at_light, l.back, -to_light, TransportMode::importance) *
                                 cosine(c.at.ng, to_light) / distance2;
    const double less =
        l.weights.ratio(made_by_camera, scatter_pdf(at_light, -to_light, l.back, TransportMode::radiance));
    const double more = c.weights.ratio(made_by_light, light_pdf(c, to_light));
    return value * arrives * static_cast<float>(1 / (1 + less + more));
  }

  int grid_;
};

}  // namespace

void plan_bdpt(const IntegratorDescription& description, Planner& planner) {
  const auto& method = std::get<BdptDescription>(description.method);
  planner.run("camera paths", depth_words(method.max_depth) + ", one at a time, each vertex joined to a light");
  planner.run("light paths", "one a camera sample, each vertex joined to the lens and to those of the camera path");
  planner.rays_one_by_one();
}

void render_bdpt(const Scene& scene, const RenderPlan& plan, const RenderJob& job, Film& film, RenderStats& stats) {
  const auto pixels = static_cast<std::uint64_t>(film.width()) * static_cast<std::uint64_t>(film.height());
  const BidirectionalTracer tracer(scene, std::get<BdptDescription>(plan.method.method), job.grid,
                                   static_cast<std::int64_t>(pixels));
  render_splats(scene, job, bdpt_stream, "bidirectional path tracing", film, stats, [&] {
    return [&, light_path = std::vector<Vertex>()](int x, int y, const PathSampler& draws, ScalarWork& work) mutable {
      const auto pixel = static_cast<std::uint64_t>(y - film.window().y0) * static_cast<std::uint64_t>(film.width()) +
                         static_cast<std::uint64_t>(x - film.window().x0);
      const PathSampler light_sampler = sampler_of_path(
          job.sampler, job.seed, work.part == FilterPart::positive ? ptracer_stream : bdpt_negative_stream,
          draws.index * pixels + pixel);
      return tracer.sample(x, y, draws, light_sampler, light_path, work);
    };
  });
}

}  // namespace photonproof::inline renderer_integrators
