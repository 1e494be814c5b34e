// Path tracing with next-event estimation and multiple importance sampling (Veach 1997, chapters 8 to 10; Kajiya 1986)
// over a batch of lanes.
//   L = sum over vertices of throughput x (w_bsdf Le(hit) + w_light f Le(light sample) cos / pdf).
// A lane that ends stores its radiance in the slot of its path, so that nothing depends on when it ended. The photon
// mapper's camera paths, pilots and the rays of an irradiance cache differ only in their policy (path_policies.h).
#pragma once

#include "renderer/kernels/path_policies.h"
#include "renderer/kernels/path_steps.h"

namespace photonproof::inline renderer_kernels {

template <class F, class Policy>
class PathKernel : public BatchKernel<PathKernel<F, Policy>, PathSteps<F>> {
  using Base = BatchKernel<PathKernel<F, Policy>, PathSteps<F>>;
  using U = UInt<F>;

 public:
  explicit PathKernel(PathTask& task) : Base(task, Policy::even_lobes) {}

  [[gnu::flatten]] Mask<F> refill(PathState<F>& s, std::uint32_t first, const Mask<F>& lanes) {
    s.throughput = Vec3<F>(F(1.0f));
    s.radiance = Vec3<F>(F(0.0f));
    s.refraction_scale = F(1.0f);
    s.from = U(no_index);
    s.path = lane_index<F>() + first;
    if constexpr (Policy::from_camera)
      return Base::start_at_camera(s, first, lanes);
    else
      return start_as_bounces(s, first, lanes);
  }

  /// Adds the lights that the rays met.
  [[gnu::flatten]] void meet_surfaces(PathState<F>& s, const Mask<F>& active) {
    const Mask<F> first = equal<F>(s.vertex, U(0u));
    SurfaceHit<F> hit = closest_hit(scene_, s.origin, s.direction, s.from, active, all(first || !active));
    if (task_.settings.hide_emitters && scene_.lights_can_be_hit) Base::pass_lights(s, hit, active && first);
    Mask<F> met = hit.valid;  // behind the far plane the camera sees the environment
    if (any(first)) met = met && !(first && beyond_far_plane(scene_.camera, hit.p));
    if constexpr (!Policy::from_camera) note_distances(s, hit.p, met && equal<F>(s.vertex, U(1u)));
    Mask<F> alive = met;
    if (scene_.lights_can_be_hit && !searches()) {
      const U light = Base::surface_word(hit.surface, &SurfaceWords::light);
      const Mask<F> shines = counted(s, alive && !equal<F>(light, U(no_index)));
      if (any(shines)) Base::add_emission(s, hit, select(shines, light, U(0u)), shines);
    }
    if (searches()) find_lights(task_.search, s, hit, active && !first && !(s.bsdf_pdf > 0));
    if constexpr (Policy::looks) alive = alive && as_mask<F>(s.vertex < U(Base::only_looks));
    if (task_.settings.max_depth >= 0)
      alive = alive && as_mask<F>(s.vertex + 1u < U(static_cast<std::uint32_t>(task_.settings.max_depth)));
    if (scene_.environment != no_index) {
      Mask<F> leaves = active && !met;
      if (task_.settings.hide_emitters) leaves = leaves && s.bsdf_pdf >= 0;
      leaves = counted(s, leaves);
      if (any(leaves)) Base::add_environment(s, leaves);
    }
    Base::retire(s, active && !alive);
    if (!any(alive)) return;
    s.from = hit.primitive;
    Base::wait({s, hit.p, hit.normal, hit.surface}, alive,
               [&] { return Base::draw(s, s.vertex + Base::Dimension::leaf).x; });
  }

  /// Adds direct light; paths end, or sample their next direction and play roulette.
  template <template <class> class Kind>
  [[gnu::flatten]] void shade(AtSurface<PathState, F>& at, const Mask<F>& active) {
    if constexpr (Kind<F>::is_lambertian)
      shade_lambertian<Kind>(at, active);
    else
      Base::template scatter<Kind>(at, active);
  }

 private:
  using Base::scene_, Base::task_;

  /// The first edge is the camera's: its surface counts as seen directly.
  Mask<F> start_as_bounces(PathState<F>& s, std::uint32_t first, const Mask<F>& lanes) {
    const BouncesView& from = task_.bounces;
    load_into(s.origin.x, from.x + first), load_into(s.origin.y, from.y + first), load_into(s.origin.z, from.z + first);
    load_into(s.direction.x, from.to_x + first), load_into(s.direction.y, from.to_y + first);
    load_into(s.direction.z, from.to_z + first);
    load_into(s.key, from.key + first), load_into(s.index, from.index + first);
    s.bsdf_pdf = F(1.0f);
    s.vertex = U(1u);
    s.gathering = U(final_gather::left_first);
    task_.counts.bounce += count_lanes(lanes);
    return lanes;
  }

  void note_distances(const PathState<F>& s, const Vec3<F>& p, const Mask<F>& lanes) {
    if (!any(lanes)) return;
    float distance[lane_count<F>];
    store_from(F(lane_sqrt(length_squared(p - s.origin))), distance);
    Base::for_each_path(s, lanes,
                        [&](std::size_t lane, std::size_t path) { task_.bounces.distance[path] = distance[lane]; });
  }

  bool searches() const {
    if constexpr (!Policy::even_lobes) return false;
    return task_.search.count > 0;
  }

  /// The paths whose rays' lights count.
  Mask<F> counted(const PathState<F>& s, const Mask<F>& rays) const {
    if constexpr (!Policy::beside_maps) return rays;
    const Mask<F> counts = rays && final_gather::counts_light<F>(s.gathering, Policy::meets_sampled_lights) &&
                           rough_gather::counts_light<F>(s.gathering);
    return task_.settings.indirect_only ? counts && !final_gather::is_direct<F>(s.gathering) : counts;
  }

  template <template <class> class Kind>
  void shade_lambertian(AtSurface<PathState, F>& at, const Mask<F>& active) {
    PathState<F>& s = at.path_state;
    const ScatteringBsdf<Kind<F>, F> bsdf = Base::template scattering_at<Kind>(at, active);
    const Vec3<F> wo_local = bsdf.at.frame.to_local(Vec3<F>(-s.direction));
    if (Base::takes_light_samples())
      Base::add_direct_light_at_lambertian(at, bsdf, wo_local, Policy::meets_sampled_lights, Base::lit(s, active));
    const Vec3<F> f = bsdf.bsdf.eval(wo_local, Vec3<F>(F(0.0f), F(0.0f), F(1.0f)));
    const Mask<F> ends = Policy::leave_points(task_, LambertianVertex<F>{at, bsdf.at.frame.n, f}, active);
    s.gathering = Policy::template after_lambertian<F>(s.gathering);
    if constexpr (Policy::looks) {
      Base::go_on_by_bsdf(at, bsdf, wo_local, active, ends);
    } else {
      Base::retire(s, ends);
      const Mask<F> going = active && !ends;
      if (any(going)) Base::go_on_by_bsdf(at, bsdf, wo_local, going, Mask<F>(false));
    }
  }
};

/// Follows all paths of the task.
template <class Policy, class F>
[[gnu::noinline]] void trace_by_policy(PathTask& task) {
  PathKernel<F, Policy>(task).run(Policy::from_camera ? task.camera.paths() : task.bounces.count);
}

}  // namespace photonproof::inline renderer_kernels
