// Steps of a camera path common to all policies: lights that it meets, light samples, scattering, roulette, its end.
// They are members of one class for all policies, so that an instruction set compiles each once.
#pragma once

#include "renderer/kernels/any_bsdf.h"
#include "renderer/kernels/batch_kernel.h"
#include "renderer/kernels/camera_rays.h"
#include "renderer/kernels/direct_light.h"
#include "renderer/kernels/final_gather.h"
#include "renderer/kernels/light_search.h"
#include "renderer/kernels/path_state.h"
#include "renderer/kernels/rough_gather.h"
#include "renderer/kernels/tasks.h"
#include "renderer/lanes/roulette.h"
#include "scenes/base/faults.h"

namespace photonproof::inline renderer_kernels {

template <class F>
class PathSteps : public BatchQueues<PathState, TransportMode::radiance, F> {
  using Base = BatchQueues<PathState, TransportMode::radiance, F>;

 protected:
  using U = UInt<F>;
  /// Dimensions of the sampler; the camera has the first.
  struct Dimension {
    static constexpr std::uint32_t first_vertex = 1, a_vertex = 5;
    static constexpr std::uint32_t light_point = 0, direction = 1, light = 2, lobe = 3, roulette = 4;  ///< of a vertex
    static constexpr std::uint32_t leaf = 1u << 24;  ///< one per vertex: which of a surface's BSDFs
  };

  /// `even_lobes` is the policy's.
  PathSteps(PathTask& task, bool even_lobes)
      : Base(*task.scene, task.scratch),
        task_(task),
        light_from_(task.settings.direct_light),
        even_lobes_(even_lobes) {}

  /// PathState::bsdf_pdf of a camera ray where emitters are hidden, until a surface scatters it.
  static constexpr float hides_environment = -1;

  /// Number of the vertex after a gather point: the path only adds light that it meets there.
  static constexpr std::uint32_t only_looks = 1u << 31;

  static U dimension_at(const PathState<F>& s) { return s.vertex * Dimension::a_vertex + Dimension::first_vertex; }

  /// Starts paths at the camera; returns which of the lanes begin one.
  [[gnu::noinline, gnu::flatten]] Mask<F> start_at_camera(PathState<F>& s, std::uint32_t first, const Mask<F>& lanes) {
    const CameraRay<F> ray = camera_rays<F>(scene_, task_.camera, first);
    s.origin = ray.origin;
    s.direction = ray.direction;
    s.key = ray.key;
    s.index = ray.index;
    s.bsdf_pdf = F(task_.settings.hide_emitters ? hides_environment : 0.0f);
    s.vertex = U(0u);
    s.gathering = U(0u);
    if (even_lobes_) s.throughput.z = F(0.0f);  // of `radiance` blue is not what a path met
    const Mask<F> begins = lanes && ray.valid;  // the others' radiance stays 0
    task_.counts.camera += count_lanes(begins);
    return begins;
  }

  /// Camera rays go on behind lights that are hidden from them, up to the first other surface. They start farther along
  /// each time, even where coordinates are so coarse that the usual offset would not leave the light.
  [[gnu::noinline]] void pass_lights(PathState<F>& s, SurfaceHit<F>& hit, const Mask<F>& from_camera) const {
    for (;;) {
      const Mask<F> passes =
          from_camera && hit.valid && !equal<F>(this->surface_word(hit.surface, &SurfaceWords::light), U(no_index));
      if (!any(passes)) return;
      const Vec3<F> off = offset_from(hit.p, hit.normal, s.direction, scene_.coordinate_floor);
      const F coordinate = lane_max(lane_max(lane_abs(s.origin.x), lane_abs(s.origin.y)), lane_abs(s.origin.z));
      const Vec3<F> least = advance(s.origin, F(0x1p-20f * coordinate), s.direction);
      const Vec3<F> behind = select(dot(Vec3<F>(off - s.origin), s.direction) > 0, off, least);
      s.origin = select(passes, behind, s.origin);
      s.from = select(passes, hit.primitive, s.from);
      const SurfaceHit<F> next = closest_hit(scene_, s.origin, s.direction, s.from, passes, false);
      hit.valid = (hit.valid && !passes) || next.valid;
      hit.p = select(passes, next.p, hit.p);
      hit.normal = select(passes, next.normal, hit.normal);
      hit.surface = select(passes, next.surface, hit.surface);
      hit.primitive = select(passes, next.primitive, hit.primitive);
    }
  }

  [[gnu::noinline, gnu::flatten]] void add_emission(PathState<F>& s, const SurfaceHit<F>& hit, const U& light,
                                                    const Mask<F>& shines) {
    const Vec3<F> emitted = emitted_radiance<F>(scene_, hit, light, shines, Vec3<F>(-s.direction));
    F weight(1.0f);
    const Mask<F> shared = shines && s.bsdf_pdf > 0;  // next-event estimation could have found it too
    if (leaves_shared_hits_out(light_from_))
      weight = select(shared, F(0.0f), F(1.0f));
    else if (light_from_ == DirectLight::weighted && any(shared) && !has_fault(Fault::unweighted_hits))
      weight =
          select(shared, mis_weight(s.bsdf_pdf, direct_light_pdf<F>(scene_, light, shared, s.origin, hit)), F(1.0f));
    if constexpr (can_have_faults)
      if (has_fault(Fault::missing_caustic))
        weight = select(s.bsdf_pdf > 0 || as_mask<F>(s.vertex < U(2u)), weight, F(0.0f));
    s.radiance = select(shines, Vec3<F>(s.radiance + s.throughput * emitted * weight), s.radiance);
  }

  /// Adds the environment to rays that met nothing. Next-event estimation could have found it, too, like other lights.
  [[gnu::noinline, gnu::flatten]] void add_environment(PathState<F>& s, const Mask<F>& leaves) {
    const EnvironmentLook<F> sky = look_at_environment(scene_, s.origin, s.direction, leaves);
    const Mask<F> shared = s.bsdf_pdf > 0;
    F weight(1.0f);
    if (leaves_shared_hits_out(light_from_))
      weight = select(shared, F(0.0f), F(1.0f));
    else if (light_from_ == DirectLight::weighted)
      weight = select(shared, mis_weight(s.bsdf_pdf, sky.pdf), F(1.0f));
    s.radiance = select(leaves, Vec3<F>(s.radiance + s.throughput * sky.radiance * weight), s.radiance);
  }

  /// The paths whose light samples a view shows.
  Mask<F> lit(const PathState<F>& s, const Mask<F>& active) const {
    return task_.settings.indirect_only ? active && !final_gather::has_left_none<F>(s.gathering) : active;
  }
  bool takes_light_samples() const { return scene_.light_count > 0 && photonproof::takes_light_samples(light_from_); }
  /// Adds direct light at a Lambertian vertex. `goes_on`: the path's next ray may meet the same light.
  template <class Record>
  [[gnu::flatten]] void add_direct_light_at_lambertian(AtSurface<PathState, F>& at,
                                                       const ScatteringBsdf<Record, F>& bsdf, const Vec3<F>& wo_local,
                                                       bool goes_on, const Mask<F>& active) {
    add_direct_light(at, bsdf, bsdf.at.frame, wo_local, dimension_at(at.path_state), goes_on, active);
  }

  /// Scatters paths at a surface that is not Lambertian: adds direct light and goes on.
  template <template <class> class Kind>
  [[gnu::noinline, gnu::flatten]] void scatter(AtSurface<PathState, F>& at, const Mask<F>& active) {
    const ScatteringBsdf<Kind<F>, F> bsdf = Base::template scattering_at<Kind>(at, active);
    const Vec3<F> wo_local = bsdf.at.frame.to_local(Vec3<F>(-at.path_state.direction));
    if constexpr (Kind<F>::has_smooth) {
      const Mask<F> takes = lit(at.path_state, active) && final_gather::without_maps<F>(at.path_state.gathering);
      if (takes_light_samples() && any(takes))
        add_direct_light_if_counted(at, bsdf, wo_local, dimension_at(at.path_state), takes);
    }
    if constexpr (CanBeRough<Kind<F>, F>)
      if (task_.rough.map.count > 0) gather_rough(at, bsdf, wo_local, active);
    go_on_by_bsdf(at, bsdf, wo_local, active, Mask<F>(false));
  }

  /// Samples the next direction of the paths `going` and plays roulette. Those `looking` only add light that they meet.
  template <class Record>
  void go_on_by_bsdf(AtSurface<PathState, F>& at, const ScatteringBsdf<Record, F>& bsdf, const Vec3<F>& wo_local,
                     const Mask<F>& going, const Mask<F>& looking) {
    PathState<F>& s = at.path_state;
    const U dimension = dimension_at(s);
    Vec2<F> u_direction{F(0.0f), F(0.0f)};
    if constexpr (Record::has_smooth) u_direction = draw(s, dimension + Dimension::direction);
    const Vec2<F> u_lobes = draw(s, dimension + Dimension::lobe);
    F u_lobe = u_lobes.x;
    if constexpr (requires { bsdf.bsdf.reflected_share(wo_local); })
      if (even_lobes_) s.throughput *= even_lobes(bsdf.bsdf.reflected_share(wo_local), u_lobe);
    const BsdfSample<F> next = bsdf.at.sample(bsdf.bsdf, wo_local, u_lobe, u_direction, TransportMode::radiance);
    s.throughput *= next.weight;
    const Mask<F> by_rough_part = split(s, bsdf.bsdf, wo_local, next, u_lobes.y);
    s.refraction_scale *= next.eta * next.eta;
    Mask<F> alive = going && next.valid && max_component(s.throughput) > 0;
    if (even_lobes_) alive = alive && next.delta;
    alive = (alive && looking) || survive_roulette(s, dimension, alive && !looking);
    retire(s, going && !alive);

    F pdf = select(next.delta, F(0.0f), next.pdf);
    if constexpr (requires { bsdf.bsdf.straight_through(wo_local); })
      if (!task_.settings.shows_behind_straight)
        pdf = select(s.bsdf_pdf < 0 && next.delta && dot(next.wi_local, wo_local) < -0.9999f, s.bsdf_pdf, pdf);
    s.bsdf_pdf = pdf;
    s.direction = normalize(bsdf.at.frame.to_world(next.wi_local));
    s.origin = offset_from(at.p, at.normal, s.direction, scene_.coordinate_floor);
    s.vertex = select(looking, U(only_looks), U(s.vertex + 1u));
    if constexpr (!Record::is_lambertian) s.gathering = after_other(s.gathering, by_rough_part);
    task_.counts.bounce += count_lanes(alive);
    Base::go_on(s, alive);
  }

  /// Calls visit(lane, path) for the lanes.
  template <class Visit>
  static void for_each_path(const PathState<F>& s, const Mask<F>& lanes, Visit&& visit) {
    std::uint32_t path[lane_count<F>];
    store_from(s.path, path);
    for (std::uint32_t bits = to_bits(lanes); bits != 0; bits &= bits - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(bits));
      visit(lane, std::size_t{path[lane]});
    }
  }

  void retire(const PathState<F>& s, const Mask<F>& ended) {
    if (!any(ended)) return;
    float red[lane_count<F>], green[lane_count<F>], blue[lane_count<F>];
    store_from(s.radiance.x, red);
    store_from(s.radiance.y, green);
    store_from(s.radiance.z, blue);
    for_each_path(s, ended, [&](std::size_t lane, std::size_t path) {
      float* out = task_.radiance + 3 * path;
      out[0] = red[lane];
      out[1] = green[lane];
      out[2] = blue[lane];
    });
  }

  Vec2<F> draw(const PathState<F>& s, const U& dimension) const {
    return draw2<F>(task_.camera.sampler, s.key, s.index, dimension);
  }

  using Base::scene_;
  PathTask& task_;
  const DirectLight light_from_;
  const bool even_lobes_;

 private:
  /// `goes_on`: the path's next ray may meet the same light.
  template <class B>
  void add_direct_light(AtSurface<PathState, F>& at, const B& bsdf, const Frame<F>& frame, const Vec3<F>& wo_local,
                        const U& dimension, bool goes_on, const Mask<F>& active) {
    PathState<F>& s = at.path_state;
    F u_choice(0.0f);
    if (!scene_.one_light) u_choice = draw(s, dimension + Dimension::light).x;
    const Vec2<F> u_point = draw(s, dimension + Dimension::light_point);
    const SurfaceHit<F> hit{active, at.p, at.normal, at.surface, s.from};
    s.radiance += s.throughput * estimate_direct<F>(scene_, hit, bsdf, frame, wo_local,
                                                    light_from_ == DirectLight::weighted && goes_on, u_choice, u_point,
                                                    active, task_.counts);
  }

  /// Direct light at rough parts that photons do not add.
  template <class Record>
  void add_direct_light_if_counted(AtSurface<PathState, F>& at, const ScatteringBsdf<Record, F>& bsdf,
                                   const Vec3<F>& wo_local, const U& dimension, const Mask<F>& active) {
    const Mask<F> behind_rough = rough_gather::is_behind_rough<F>(at.path_state.gathering);
    if (!task_.rough.by_photons || !any(active && behind_rough)) {
      add_direct_light_once_compiled(at, any_bsdf<F>(bsdf), bsdf.at.frame, wo_local, dimension, active);
    } else if constexpr (CanBeRough<Record, F>) {
      const ScatteringBsdf<RoughPart<Record, F>, F> part{{bsdf.bsdf, scene_.rough_limit, !behind_rough}, bsdf.at};
      add_direct_light_once_compiled(at, any_bsdf<F>(part), bsdf.at.frame, wo_local, dimension, active);
    } else {
      add_direct_light_once_compiled(at, any_bsdf<F>(bsdf), bsdf.at.frame, wo_local, dimension,
                                     active && !behind_rough);
    }
  }

  /// All kinds except the Lambertian share one copy of the code that chooses lights and traces shadow rays. A copy each
  /// would take minutes to compile, and a call costs them little.
  [[gnu::noinline]] void add_direct_light_once_compiled(AtSurface<PathState, F>& at, const AnyBsdf<F>& bsdf,
                                                        const Frame<F>& frame, const Vec3<F>& wo_local,
                                                        const U& dimension, const Mask<F>& active) {
    add_direct_light(at, bsdf, frame, wo_local, dimension, true, active);
  }

  /// Decides which paths a rough part has scattered.
  template <class Record>
  Mask<F> split(PathState<F>& s, const Record& bsdf, const Vec3<F>& wo_local, const BsdfSample<F>& next,
                const F& u) const {
    if constexpr (CanBeRough<Record, F>) {
      if (task_.rough.by_photons) {
        const Mask<F> smooth = next.valid && !next.delta && final_gather::has_left_none<F>(s.gathering);
        Vec3<F> weight(F(1.0f));
        const Mask<F> rough =
            is_by_rough_part<F>(bsdf.rough_share(scene_.rough_limit, wo_local, next.wi_local), u, weight);
        s.throughput = select(smooth, Vec3<F>(s.throughput * weight), s.throughput);
        return smooth && rough;
      }
    }
    return Mask<F>(false);
  }

  /// PathState::gathering after a vertex that is not Lambertian.
  U after_other(const U& gathering, const Mask<F>& by_rough_part) const {
    const U after = final_gather::leave_other<F>(gathering);
    if (!task_.rough.by_photons) return after;
    return select(final_gather::has_left_none<F>(gathering), rough_gather::after<F>(gathering, by_rough_part), after);
  }

  /// Gathers caustic photons at rough parts.
  template <class Record>
  [[gnu::noinline]] void gather_rough(const AtSurface<PathState, F>& at, const ScatteringBsdf<Record, F>& bsdf,
                                      const Vec3<F>& wo_local, const Mask<F>& active) {
    RoughGathers& rough = task_.rough;
    const PathState<F>& s = at.path_state;
    const Mask<F> looks = active && bsdf.bsdf.is_rough(scene_.rough_limit) && wo_local.z > 0 &&
                          max_component(s.throughput) > 0 && final_gather::has_left_none<F>(s.gathering);
    const UInt<F> surface_side = side_word<F>(at.normal, Vec3<F>(-s.direction));
    for (std::uint32_t bits = to_bits(looks); bits != 0; bits &= bits - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(bits));
      if (rough.points.count == rough.room) rough.make_room(task_);
      rough_gather::Point<F, Record> point(bsdf, scene_.rough_limit, wo_local, lane);
      point.radiance_estimate(rough, {lane_of(at.p, lane), lane_of(s.throughput, lane), lane_of(s.path, lane),
                                      surface_number(lane_of(at.surface, lane)) | PhotonSurface::rough,
                                      lane_of(s.vertex, lane) + 1, lane_of(surface_side, lane)});
    }
  }

  /// Unbiased: from rr_depth on, survive with a probability by the largest channel and divide by it.
  Mask<F> survive_roulette(PathState<F>& s, const U& dimension, const Mask<F>& alive) const {
    const Mask<F> mortal = alive && as_mask<F>(s.vertex + 1u >= U(static_cast<std::uint32_t>(task_.settings.rr_depth)));
    if (!any(mortal)) return alive;
    const F weight = max_component(s.throughput) * s.refraction_scale;
    const F q = survival_probability<F>(weight, U(s.vertex + 1u), task_.settings.rr_depth);
    s.throughput *= select(mortal, has_fault(Fault::unpaid_roulette) ? F(1.0f) : F(1 / q), F(1.0f));
    return alive && (!mortal || draw_independent<F>(s.key, s.index, U(dimension + Dimension::roulette)) < q);
  }
};

}  // namespace photonproof::inline renderer_kernels
