// Next-event estimation for a pack: one light, one point on it, one shadow ray per lane.
#pragma once

#include "renderer/core/ray_counts.h"
#include "renderer/kernels/lights.h"
#include "renderer/lanes/warp.h"
#include "renderer/rays/rays.h"
#include "scenes/base/faults.h"

namespace photonproof::inline renderer_kernels {

/// Power heuristic, exponent 2 (Veach 1997, section 9.2.4): the weight of a sample of density `pdf` against `other`.
template <class F>
F mis_weight(const F& pdf, const F& other) {
  const F ratio = other / pdf;  // squares of densities near lights of no size would overflow
  return select(pdf > 0, 1 / mul_add(ratio, ratio, F(1.0f)), F(0.0f));
}

/// Radiance reflected towards wo from one sample of one light. With `weighted` the sample has its MIS weight against
/// BSDF sampling; otherwise it stands alone. Shadow rays are only traced where the BSDF and both cosines are not 0.
template <class F, class B>
Vec3<F> estimate_direct(const SceneView& scene, const SurfaceHit<F>& hit, const B& bsdf, const Frame<F>& frame,
                        const Vec3<F>& wo_local, bool weighted, const F& u_choice, const Vec2<F>& u_point,
                        const Mask<F>& active, RayCounts& counts) {
  const LightSampling<F> choice = choose_light(scene, hit.p, active, u_choice);
  Mask<F> findable;
  const LightSample<F> s = sample_light(scene, choice.light, active, hit.p, u_point, findable);
  const Vec3<F> wi_local = frame.to_local(s.wi);
  const Vec3<F> f = bsdf.eval(wo_local, wi_local);
  const Mask<F> bright = active && s.pdf * choice.probability > 0 && max_component(f) > 0;
  const Mask<F> lit = scene.dark_shadow_rays ? active : bright;
  if (!any(lit)) return Vec3<F>(F(0.0f));
  counts.shadow += count_lanes(lit);

  const Vec3<F> from = offset_from(hit.p, hit.normal, s.wi, scene.coordinate_floor);
  Vec3<F> to = s.at.p;
  if (!scene.small) to = offset_from(to, s.at.normal, Vec3<F>(-s.wi), scene.coordinate_floor);
  const UInt<F> target = choice.primitive + s.at.triangle;
  const Mask<F> visible = bright && !occluded(scene, from, Vec3<F>(to - from), hit.primitive, target, lit);

  const F pdf = s.pdf * choice.probability;
  F weight = (has_fault(Fault::dropped_cosine) ? F(1.0f) : lane_abs(wi_local.z)) / pdf;
  if (weighted) weight *= select(findable, mis_weight(pdf, bsdf.pdf(wo_local, wi_local)), F(1.0f));
  return select(visible, Vec3<F>(f * s.radiance * weight), Vec3<F>(F(0.0f)));
}

}  // namespace photonproof::inline renderer_kernels
