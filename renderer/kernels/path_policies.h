// Policies of the path kernel: which paths it follows. A policy type decides where paths start, whether a light that a
// ray meets counts, and the action at a Lambertian vertex. Every other vertex scatters all paths alike (path_steps.h).
// final_gather.h lists the classes of paths that each one counts, and the photons that contribute the others.
//
// A policy has these constants.
//   `from_camera`           Paths start at the camera; else at BouncesView.
//   `beside_maps`           PathState::gathering decides whether a light that a ray meets counts; else each one does.
//   `meets_sampled_lights`  After a Lambertian vertex the ray may meet the light that was sampled there, so both are
//                           weighted.
//   `looks`                 A path that ends at a Lambertian vertex follows one more ray, to a light.
//   `even_lobes`            Smooth interfaces choose both lobes equally often; nothing else scatters (light_search.h).
// It also has functions; they are templates, so that each instruction set compiles its own.
//   `leave_points(task, vertex, active)`  Leaves gather points at a Lambertian vertex; returns paths that end there.
//   `after_lambertian(gathering)`         PathState::gathering behind such a vertex.
#pragma once

#include <bit>

#include "renderer/kernels/batch_kernel.h"
#include "renderer/kernels/final_gather.h"
#include "renderer/kernels/path_state.h"
#include "renderer/kernels/tasks.h"

namespace photonproof::inline renderer_kernels {

/// Paths at a Lambertian surface. `f` is the BSDF's value, the same for all directions above the surface.
template <class F>
struct LambertianVertex {
  const AtSurface<PathState, F>& at;
  const Vec3<F> shading_normal, f;

  const UInt<F>& gathering() const { return at.path_state.gathering; }

  /// Leaves one gather point per path. It has no direction: its weight is for any photon.
  void leave_point(const Mask<F>& active, GatherPoints& points) const {
    const Vec3<F> weight = at.path_state.throughput * f;
    const std::uint32_t bits = to_bits(Mask<F>(active && max_component(weight) > 0));
    if (bits == 0) return;
    const auto put = [&](auto* column, const auto& value) {
      compress_store(value, bits, reinterpret_cast<std::uint32_t*>(column + points.count));
    };
    put(points.x, at.p.x), put(points.y, at.p.y), put(points.z, at.p.z);
    put(points.weight_red, weight.x), put(points.weight_green, weight.y), put(points.weight_blue, weight.z);
    put(points.path, at.path_state.path);
    put(points.surface, at.surface);
    put(points.edges, UInt<F>(at.path_state.vertex + 1u));
    put(points.surface_side, side_word<F>(at.normal, shading_normal));
    points.count += static_cast<std::size_t>(std::popcount(bits));
  }

  /// Leaves points for caustic photons alone.
  void leave_caustic_point(const Mask<F>& active, PathTask& task) const {
    if (task.caustic_points.x == nullptr) return;
    const Mask<F> later = !final_gather::has_left_none<F>(gathering());
    leave_point(task.caustics_at_first ? active : active && later, task.caustic_points);
  }
};

/// Path tracing without maps. It estimates all radiance along the camera ray. Every light that a ray meets counts, with
/// its weight against light samples. A path ends where it leaves the scene, is absorbed, is ended by roulette or
/// reaches the depth limit.
struct PathTracing {
  static constexpr bool from_camera = true, beside_maps = false, meets_sampled_lights = true;
  static constexpr bool looks = false, even_lobes = false;

  template <class F>
  static Mask<F> leave_points(PathTask&, const LambertianVertex<F>&, const Mask<F>&) {
    return Mask<F>(false);
  }
  template <class F>
  static UInt<F> after_lambertian(const UInt<F>& gathering) {
    return gathering;
  }
};

/// The photon mapper's camera pass. It estimates direct light up to the first Lambertian vertex, and leaves a gather
/// point there for both maps. A light that a ray meets counts, unless caustic photons add it (rough_gather.h). A path
/// ends at its first Lambertian vertex at the latest. With `looks_on` it follows one more ray from there, which shares
/// the light with the light samples; without, the light samples add all of it.
template <bool looks_on>
struct GatherPass {
  static constexpr bool from_camera = true, beside_maps = true, meets_sampled_lights = looks_on;
  static constexpr bool looks = looks_on, even_lobes = false;

  template <class F>
  static Mask<F> leave_points(PathTask& task, const LambertianVertex<F>& vertex, const Mask<F>& active) {
    vertex.leave_point(active, task.points);
    return active;
  }
  template <class F>
  static UInt<F> after_lambertian(const UInt<F>& gathering) {
    return final_gather::leave_lambertian<F>(gathering);
  }
};

/// The camera pass of a final gather. It estimates direct light at the first Lambertian vertex x and at the second, y.
/// It leaves a caustic point at x and a gather point for both maps at y. A light that a ray meets counts on the way to
/// x, and with `looks_on` at the end of a ray that leaves x or y. A path ends at y, or, where y is nearer than
/// `near_hit`, one Lambertian vertex later.
template <bool looks_on>
struct FinalGatherPass {
  static constexpr bool from_camera = true, beside_maps = true, meets_sampled_lights = looks_on;
  static constexpr bool looks = looks_on, even_lobes = false;

  template <class F>
  static Mask<F> leave_points(PathTask& task, const LambertianVertex<F>& vertex, const Mask<F>& active) {
    const F squared_distance = length_squared(vertex.at.p - vertex.at.path_state.origin);
    const Mask<F> ends = active && final_gather::ends<F>(vertex.gathering(), squared_distance, task.near_hit);
    vertex.leave_caustic_point(active && !ends, task);
    vertex.leave_point(ends, task.points);
    return ends;
  }
  template <class F>
  static UInt<F> after_lambertian(const UInt<F>& gathering) {
    return final_gather::leave_lambertian<F>(gathering);
  }
};

/// Rays from a point that an irradiance cache gathers. It estimates radiance that arrives there, without direct light.
/// Each ray is a bounce of a final gather from x, and ends as one does. A light that a ray meets does not count. The
/// ray's length goes to BouncesView::distance.
struct CacheRays : FinalGatherPass<false> {
  static constexpr bool from_camera = false;
};

/// Path tracing beside a caustic map. It estimates all radiance except caustics at the first two Lambertian vertices,
/// which leave a caustic point and a gather point for them. A light that a ray meets counts, unless these photons add
/// it. A path ends as in PathTracing.
struct PathsBesideCaustics {
  static constexpr bool from_camera = true, beside_maps = true, meets_sampled_lights = true;
  static constexpr bool looks = false, even_lobes = false;

  template <class F>
  static Mask<F> leave_points(PathTask& task, const LambertianVertex<F>& vertex, const Mask<F>& active) {
    const Mask<F> first = final_gather::has_left_none<F>(vertex.gathering());
    const Mask<F> second = final_gather::looks_caustics_up<F>(vertex.gathering()) && !first;
    vertex.leave_caustic_point(active && first, task);
    if (task.points.x != nullptr) vertex.leave_point(active && second, task.points);
    return Mask<F>(false);
  }
  template <class F>
  static UInt<F> after_lambertian(const UInt<F>& gathering) {
    return final_gather::go_on_from_lambertian<F>(gathering);
  }
};

/// A pilot that searches for lights behind mirrors and glass (light_search.h). It estimates the noise of paths that
/// meet one: `radiance` is what a path met and how near it came to more. LightSearch decides which lights count;
/// without it lights that rays meet do. A path ends at the first vertex that is not a smooth interface, and leaves a
/// gather point if that is Lambertian.
struct PilotPass {
  static constexpr bool from_camera = true, beside_maps = false, meets_sampled_lights = false;
  static constexpr bool looks = false, even_lobes = true;

  template <class F>
  static Mask<F> leave_points(PathTask& task, const LambertianVertex<F>& vertex, const Mask<F>& active) {
    vertex.leave_point(active, task.points);
    return active;
  }
  template <class F>
  static UInt<F> after_lambertian(const UInt<F>& gathering) {
    return gathering;
  }
};

/// Calls visit(value of the policy type).
template <class Visit>
void with_policy(PathPolicy policy, Visit&& visit) {
  switch (policy) {
    case PathPolicy::path_tracing:
      return visit(PathTracing{});
    case PathPolicy::gather_pass:
      return visit(GatherPass<false>{});
    case PathPolicy::gather_pass_looks:
      return visit(GatherPass<true>{});
    case PathPolicy::final_gather:
      return visit(FinalGatherPass<false>{});
    case PathPolicy::final_gather_looks:
      return visit(FinalGatherPass<true>{});
    case PathPolicy::beside_caustic_map:
      return visit(PathsBesideCaustics{});
    case PathPolicy::pilot_pass:
      return visit(PilotPass{});
    case PathPolicy::cache_rays:
      return visit(CacheRays{});
  }
}

}  // namespace photonproof::inline renderer_kernels
