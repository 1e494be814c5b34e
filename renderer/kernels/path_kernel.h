// Path tracing with next-event estimation and multiple importance sampling (Veach 1997, chapters 8 to 10; Kajiya 1986)
// over a batch of lanes.
//   L = sum over vertices of throughput x (w_bsdf Le(hit) + w_light f Le(light sample) cos / pdf)
// A lane that ends leaves its radiance in the slot of its path, so that nothing depends on when it ended. The photon
// mapper's camera paths are the same up to their first Lambertian surface, where they leave a gather point instead, or
// go on as final_gather.h says.
#pragma once

#include "renderer/kernels/any_bsdf.h"
#include "renderer/kernels/batch_kernel.h"
#include "renderer/kernels/camera_rays.h"
#include "renderer/kernels/direct_light.h"
#include "renderer/kernels/final_gather.h"
#include "renderer/kernels/lamp_search.h"
#include "renderer/kernels/rough_look_up.h"
#include "renderer/kernels/tasks.h"
#include "renderer/lanes/roulette.h"
#include "scenes/base/faults.h"

namespace photonproof::inline renderer_kernels {

template <class F>
struct PathState {
  Vec3<F> origin, direction;  ///< the next ray
  Vec3<F> throughput, radiance;
  F bsdf_pdf;  ///< density of `direction`; 0 after a delta BSDF and from the camera: nothing else could find it.
               ///< Negative where the ray shows no environment (hides_environment)
  F refraction_scale;  ///< undoes the squared index ratios in the throughput, for roulette
  UInt<F> from;        ///< primitive the ray leaves
  UInt<F> vertex;      ///< edges before the next ray
  UInt<F> key, index;  ///< of the sampler
  UInt<F> path;
  UInt<F> gathering;  ///< final_gather's bits

  static constexpr std::size_t column_count = 20;
  template <class Self, class Visit>
  static void columns(Self& s, Visit&& visit) {
    const auto visit3 = [&](auto& v) { visit(v.x), visit(v.y), visit(v.z); };
    visit3(s.origin), visit3(s.direction), visit3(s.throughput), visit3(s.radiance);
    visit(s.bsdf_pdf), visit(s.refraction_scale);
    visit(s.from), visit(s.vertex), visit(s.key), visit(s.index), visit(s.path);
    visit(s.gathering);
  }
};

template <class F>
class PathKernel : public BatchKernel<PathKernel<F>, PathState, TransportMode::radiance, F> {
  using Base = BatchKernel<PathKernel<F>, PathState, TransportMode::radiance, F>;
  using U = UInt<F>;
  /// Of the sampler; the camera has the first.
  struct Dimension {
    static constexpr std::uint32_t first_vertex = 1, a_vertex = 5;
    static constexpr std::uint32_t light_point = 0, direction = 1, light = 2, lobe = 3, roulette = 4;  ///< of a vertex
    static constexpr std::uint32_t leaf = 1u << 24;  ///< one a vertex: which of a surface's BSDFs
  };

 public:
  explicit PathKernel(PathTask& task)
      : Base(*task.scene, task.scratch),
        task_(task),
        light_from_(task.settings.direct_light),
        looks_(task.at_diffuse == AtDiffuse::leave_gather_point_and_look ||
               task.at_diffuse == AtDiffuse::final_gather_and_look),
        beside_caustics_(task.at_diffuse == AtDiffuse::go_on_beside_caustic_map),
        weighs_hits_(looks_ || beside_caustics_),
        gathers_further_(task.at_diffuse == AtDiffuse::final_gather ||
                         task.at_diffuse == AtDiffuse::final_gather_and_look),
        bears_bits_(beside_caustics_ || gathers_further_ || task.rough.by_photons) {}

  [[gnu::flatten]] Mask<F> refill(PathState<F>& s, std::uint32_t first, const Mask<F>& lanes) {
    if (task_.bounces.count > 0) return refill_bounces(s, first, lanes);
    const CameraRay<F> ray = camera_rays<F>(scene_, task_.camera, first);
    s.origin = ray.origin;
    s.direction = ray.direction;
    s.key = ray.key;
    s.index = ray.index;
    s.bsdf_pdf = F(task_.settings.hide_emitters ? hides_environment : 0.0f);
    s.vertex = U(0u);
    s.gathering = U(0u);
    begin(s, first);
    if (task_.is_pilot) s.throughput.z = F(0.0f);
    const Mask<F> begins = lanes && ray.valid;  // the others' radiance stays 0
    task_.counts.camera += count_lanes(begins);
    return begins;
  }

  /// Adds the lights that the rays met.
  [[gnu::flatten]] void meet_surfaces(PathState<F>& s, const Mask<F>& active) {
    const Mask<F> first = equal<F>(s.vertex, U(0u));
    SurfaceHit<F> hit = closest_hit(scene_, s.origin, s.direction, s.from, active, all(first || !active));
    if (task_.settings.hide_emitters && scene_.lights_can_be_hit) pass_lamps(s, hit, active && first);
    Mask<F> met = hit.valid;  // behind the far plane the camera sees the environment
    if (any(first)) met = met && !(first && beyond_far_plane(scene_.camera, hit.p));
    if (task_.bounces.count > 0) note_distances(s, hit.p, met && equal<F>(s.vertex, U(1u)));
    Mask<F> alive = met;
    if (scene_.lights_can_be_hit) {
      const U light = Base::surface_word(hit.surface, &SurfaceWords::light);
      Mask<F> shines = alive && !equal<F>(light, U(no_index));
      if (bears_bits_) shines = shines && counts_hits(s);
      if (any(shines) && task_.search.count == 0) add_emission(s, hit, select(shines, light, U(0u)), shines);
    }
    if (task_.search.count > 0) find_lamps(task_.search, s, hit, active && !first && !(s.bsdf_pdf > 0));
    if (looks_) alive = alive && as_mask<F>(s.vertex < U(only_looks));
    if (task_.settings.max_depth >= 0)
      alive = alive && as_mask<F>(s.vertex + 1u < U(static_cast<std::uint32_t>(task_.settings.max_depth)));
    if (scene_.environment != no_index) {
      Mask<F> leaves = active && !met;
      if (task_.settings.hide_emitters) leaves = leaves && s.bsdf_pdf >= 0;
      if (bears_bits_) leaves = leaves && counts_hits(s);
      if (any(leaves)) add_environment(s, leaves);
    }
    retire(s, active && !alive);
    if (!any(alive)) return;
    s.from = hit.primitive;
    Base::wait({s, hit.p, hit.normal, hit.surface}, alive, [&] { return draw(s, s.vertex + Dimension::leaf).x; });
  }

  /// Adds direct light, draws the next direction and plays roulette.
  template <template <class> class Kind>
  [[gnu::flatten]] void shade(AtSurface<PathState, F>& at, const Mask<F>& active) {
    PathState<F>& s = at.history;
    const ScatteringBsdf<Kind<F>, F> bsdf = Base::template scattering_at<Kind>(at, active);
    const Frame<F>& frame = bsdf.at.frame;
    const Vec3<F> wo_local = frame.to_local(Vec3<F>(-s.direction));
    const U dimension = s.vertex * Dimension::a_vertex + Dimension::first_vertex;
    const bool gathers = Kind<F>::is_lambertian && task_.at_diffuse != AtDiffuse::go_on;
    const Mask<F> lit = task_.settings.indirect_only ? active && !final_gather::has_left_none<F>(s.gathering) : active;
    if constexpr (Kind<F>::has_smooth) {
      if (scene_.light_count > 0 && takes_light_samples(light_from_)) {
        if constexpr (Kind<F>::is_lambertian)
          add_direct_light(at, bsdf, frame, wo_local, dimension, !gathers || weighs_hits_, lit);
        else if (const Mask<F> takes = lit && final_gather::without_maps<F>(s.gathering); any(takes))
          add_direct_light_if_counted(at, bsdf, wo_local, dimension, takes);
      }
    }
    if constexpr (CanBeRough<Kind<F>, F>)
      if (task_.rough.map.count > 0) look_up_rough(at, bsdf, wo_local, active);
    Mask<F> ends(false);  // at a gather point
    if constexpr (Kind<F>::is_lambertian) {
      if (gathers) {
        const Vec3<F> f = bsdf.bsdf.eval(wo_local, Vec3<F>(F(0.0f), F(0.0f), F(1.0f)));
        ends = leave_points(at, frame.n, f, active);
        if (!looks_) retire(s, ends);
        if (!looks_ && !any(active && !ends)) return;
      }
    }
    const Mask<F> looking = ends && Mask<F>(looks_);
    const Mask<F> going = active && (!ends || looking);
    Vec2<F> u_direction{F(0.0f), F(0.0f)};
    if constexpr (Kind<F>::has_smooth) u_direction = draw(s, dimension + Dimension::direction);
    const Vec2<F> u_lobes = draw(s, dimension + Dimension::lobe);
    F u_lobe = u_lobes.x;
    if constexpr (requires { bsdf.bsdf.reflected_share(wo_local); })
      if (task_.is_pilot) s.throughput *= even_lobes(bsdf.bsdf.reflected_share(wo_local), u_lobe);
    const BsdfSample<F> next = bsdf.at.sample(bsdf.bsdf, wo_local, u_lobe, u_direction, TransportMode::radiance);
    s.throughput *= next.weight;
    const Mask<F> by_rough_part = split(s, bsdf.bsdf, wo_local, next, u_lobes.y);
    s.refraction_scale *= next.eta * next.eta;
    Mask<F> alive = going && next.valid && max_component(s.throughput) > 0;
    if (task_.is_pilot) alive = alive && next.delta;
    alive = (alive && looking) || survive_roulette(s, dimension, alive && !looking);
    retire(s, going && !alive);

    F pdf = select(next.delta, F(0.0f), next.pdf);
    if constexpr (requires { bsdf.bsdf.straight_through(wo_local); })
      if (!task_.settings.shows_behind_straight)
        pdf = select(s.bsdf_pdf < 0 && next.delta && dot(next.wi_local, wo_local) < -0.9999f, s.bsdf_pdf, pdf);
    s.bsdf_pdf = pdf;
    s.direction = normalize(frame.to_world(next.wi_local));
    s.origin = offset_from(at.p, at.normal, s.direction, scene_.coordinate_floor);
    s.vertex = select(looking, U(only_looks), U(s.vertex + 1u));
    if (bears_bits_) s.gathering = bits_after<Kind<F>::is_lambertian>(s.gathering, by_rough_part);
    task_.counts.bounce += count_lanes(alive);
    Base::go_on(s, alive);
  }

 private:
  using Base::scene_;

  /// However a path starts.
  static void begin(PathState<F>& s, std::uint32_t first) {
    s.throughput = Vec3<F>(F(1.0f));
    s.radiance = Vec3<F>(F(0.0f));
    s.refraction_scale = F(1.0f);
    s.from = U(no_index);
    s.path = lane_index<F>() + first;
  }

  /// The first edge is the camera's: its surface is taken as seen directly.
  Mask<F> refill_bounces(PathState<F>& s, std::uint32_t first, const Mask<F>& lanes) {
    const BouncesView& from = task_.bounces;
    load_into(s.origin.x, from.x + first), load_into(s.origin.y, from.y + first), load_into(s.origin.z, from.z + first);
    load_into(s.direction.x, from.to_x + first), load_into(s.direction.y, from.to_y + first);
    load_into(s.direction.z, from.to_z + first);
    load_into(s.key, from.key + first), load_into(s.index, from.index + first);
    s.bsdf_pdf = F(1.0f);
    s.vertex = U(1u);
    s.gathering = U(final_gather::left_first);
    begin(s, first);
    task_.counts.bounce += count_lanes(lanes);
    return lanes;
  }

  /// PathState::bsdf_pdf of a camera ray where emitters are hidden, until a surface scatters it.
  static constexpr float hides_environment = -1;

  /// Camera rays go on behind lamps that are hidden from them, up to the first other surface. They start farther along
  /// each time, even where coordinates are so coarse that moving off the lamp does not get there.
  [[gnu::noinline]] void pass_lamps(PathState<F>& s, SurfaceHit<F>& hit, const Mask<F>& from_camera) const {
    for (;;) {
      const Mask<F> passes =
          from_camera && hit.valid && !equal<F>(Base::surface_word(hit.surface, &SurfaceWords::light), U(no_index));
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

  void note_distances(const PathState<F>& s, const Vec3<F>& p, const Mask<F>& lanes) {
    if (!any(lanes)) return;
    float distance[lane_count<F>];
    store_from(F(lane_sqrt(length_squared(p - s.origin))), distance);
    for_each_path(s, lanes, [&](std::size_t lane, std::size_t path) { task_.bounces.distance[path] = distance[lane]; });
  }

  /// Light that the path's ray meets.
  Mask<F> counts_hits(const PathState<F>& s) const {
    const Mask<F> counts =
        final_gather::counts_light<F>(s.gathering, weighs_hits_) && rough_look_up::counts_light<F>(s.gathering);
    return task_.settings.indirect_only ? counts && !final_gather::is_direct<F>(s.gathering) : counts;
  }

  template <bool is_lambertian>
  U bits_after(const U& gathering, const Mask<F>& by_rough_part) const {
    if constexpr (!is_lambertian) {
      if (!task_.rough.by_photons) return final_gather::leave_other<F>(gathering);
      return select(final_gather::has_left_none<F>(gathering), rough_look_up::after<F>(gathering, by_rough_part),
                    final_gather::leave_other<F>(gathering));
    }
    return beside_caustics_ ? final_gather::go_on_from_lambertian<F>(gathering)
                            : final_gather::leave_lambertian<F>(gathering);
  }

  /// Number of the vertex after a gather point: the path only sees what light is there.
  static constexpr std::uint32_t only_looks = 1u << 31;

  void add_emission(PathState<F>& s, const SurfaceHit<F>& hit, const U& light, const Mask<F>& shines) {
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

  /// Of rays that met nothing. Next-event estimation could have found the environment too, as any other light.
  void add_environment(PathState<F>& s, const Mask<F>& leaves) {
    const EnvironmentLook<F> sky = look_at_environment(scene_, s.origin, s.direction, leaves);
    const Mask<F> shared = s.bsdf_pdf > 0;
    F weight(1.0f);
    if (leaves_shared_hits_out(light_from_))
      weight = select(shared, F(0.0f), F(1.0f));
    else if (light_from_ == DirectLight::weighted)
      weight = select(shared, mis_weight(s.bsdf_pdf, sky.pdf), F(1.0f));
    s.radiance = select(leaves, Vec3<F>(s.radiance + s.throughput * sky.radiance * weight), s.radiance);
  }

  /// `goes_on`: the path may meet the same light by itself.
  template <class B>
  void add_direct_light(AtSurface<PathState, F>& at, const B& bsdf, const Frame<F>& frame, const Vec3<F>& wo_local,
                        const U& dimension, bool goes_on, const Mask<F>& active) {
    PathState<F>& s = at.history;
    F u_choice(0.0f);
    if (!scene_.one_light) u_choice = draw(s, dimension + Dimension::light).x;
    const Vec2<F> u_point = draw(s, dimension + Dimension::light_point);
    const SurfaceHit<F> hit{active, at.p, at.normal, at.surface, s.from};
    s.radiance += s.throughput * estimate_direct<F>(scene_, hit, bsdf, frame, wo_local,
                                                    light_from_ == DirectLight::weighted && goes_on, u_choice, u_point,
                                                    active, task_.counts);
  }

  /// What other than photons brings at rough parts.
  template <class Record>
  void add_direct_light_if_counted(AtSurface<PathState, F>& at, const ScatteringBsdf<Record, F>& bsdf,
                                   const Vec3<F>& wo_local, const U& dimension, const Mask<F>& active) {
    const Mask<F> behind_rough = rough_look_up::is_behind_rough<F>(at.history.gathering);
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

  /// For caustic photons, at rough parts.
  template <class Record>
  [[gnu::noinline]] void look_up_rough(const AtSurface<PathState, F>& at, const ScatteringBsdf<Record, F>& bsdf,
                                       const Vec3<F>& wo_local, const Mask<F>& active) {
    RoughLookUps& rough = task_.rough;
    const PathState<F>& s = at.history;
    const Mask<F> looks = active && bsdf.bsdf.is_rough(scene_.rough_limit) && wo_local.z > 0 &&
                          max_component(s.throughput) > 0 && final_gather::has_left_none<F>(s.gathering);
    const UInt<F> sheet = sheet_word<F>(at.normal, Vec3<F>(-s.direction));
    for (std::uint32_t bits = to_bits(looks); bits != 0; bits &= bits - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(bits));
      if (rough.points.count == rough.room) rough.make_room(task_);
      rough_look_up::Point<F, Record> point(bsdf, scene_.rough_limit, wo_local, lane);
      point.look_up(rough, {lane_of(at.p, lane), lane_of(s.throughput, lane), lane_of(s.path, lane),
                            surface_number(lane_of(at.surface, lane)) | PhotonSurface::rough,
                            lane_of(s.vertex, lane) + 1, lane_of(sheet, lane)});
    }
  }

  /// All kinds but the Lambertian share one copy of the code that chooses lights and traces shadow rays: a copy each
  /// would take minutes to compile, and calls cost them little.
  [[gnu::noinline]] void add_direct_light_once_compiled(AtSurface<PathState, F>& at, const AnyBsdf<F>& bsdf,
                                                        const Frame<F>& frame, const Vec3<F>& wo_local,
                                                        const U& dimension, const Mask<F>& active) {
    add_direct_light(at, bsdf, frame, wo_local, dimension, true, active);
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

  /// At Lambertian surfaces; returns which paths end there.
  Mask<F> leave_points(const AtSurface<PathState, F>& at, const Vec3<F>& shading_normal, const Vec3<F>& f,
                       const Mask<F>& active) {
    Mask<F> ends = active;
    const PathState<F>& s = at.history;
    if (beside_caustics_) {
      const Mask<F> first = final_gather::has_left_none<F>(s.gathering);
      const Mask<F> second = final_gather::looks_caustics_up<F>(s.gathering) && !first;
      leave_caustic_points(at, shading_normal, f, active && first);
      if (task_.points.x != nullptr) leave_gather_points(at, shading_normal, f, active && second, task_.points);
      return Mask<F>(false);
    }
    if (gathers_further_) {
      ends = active && final_gather::ends<F>(s.gathering, length_squared(at.p - s.origin), task_.near_hit);
      leave_caustic_points(at, shading_normal, f, active && !ends);
    }
    leave_gather_points(at, shading_normal, f, ends, task_.points);
    return ends;
  }

  /// For caustic photons alone.
  void leave_caustic_points(const AtSurface<PathState, F>& at, const Vec3<F>& shading_normal, const Vec3<F>& f,
                            const Mask<F>& active) {
    if (task_.caustic_points.x == nullptr) return;
    const Mask<F> later = !final_gather::has_left_none<F>(at.history.gathering);
    leave_gather_points(at, shading_normal, f, task_.caustics_at_first ? active : active && later,
                        task_.caustic_points);
  }

  /// A gather point has no direction: its weight is for any photon.
  void leave_gather_points(const AtSurface<PathState, F>& at, const Vec3<F>& shading_normal, const Vec3<F>& f,
                           const Mask<F>& active, GatherPoints& points) {
    const Vec3<F> weight = at.history.throughput * f;
    const std::uint32_t bits = to_bits(Mask<F>(active && max_component(weight) > 0));
    if (bits == 0) return;
    const auto put = [&](auto* column, const auto& value) {
      compress_store(value, bits, reinterpret_cast<std::uint32_t*>(column + points.count));
    };
    put(points.x, at.p.x), put(points.y, at.p.y), put(points.z, at.p.z);
    put(points.weight_red, weight.x), put(points.weight_green, weight.y), put(points.weight_blue, weight.z);
    put(points.path, at.history.path);
    put(points.surface, at.surface);
    put(points.edges, U(at.history.vertex + 1u));
    put(points.sheet, sheet_word<F>(at.normal, shading_normal));
    points.count += static_cast<std::size_t>(std::popcount(bits));
  }

  Vec2<F> draw(const PathState<F>& s, const U& dimension) const {
    return draw2<F>(task_.camera.sampler, s.key, s.index, dimension);
  }

  PathTask& task_;
  const DirectLight light_from_;
  const bool looks_;            ///< for light from gather points
  const bool beside_caustics_;  ///< final_gather.h
  const bool weighs_hits_;      ///< light samples at gather points leave their share to rays that meet lights
  const bool gathers_further_;  ///< final_gather.h
  const bool bears_bits_;       ///< of final_gather.h and rough_look_up.h
};

}  // namespace photonproof::inline renderer_kernels
