// Lambertian reflection, one-sided: f = reflectance / pi above the surface, 0 below.
#pragma once

#include "renderer/bsdfs/bsdf_sample.h"
#include "renderer/lanes/warp.h"
#include "scenes/base/faults.h"

namespace photonproof::inline renderer_bsdfs {

template <class F>
struct DiffuseBsdf {
  static constexpr bool has_smooth = true;
  static constexpr bool is_lambertian = true;
  static constexpr bool lets_light_through = false;
  Vec3<F> reflectance;

  Vec3<F> eval(const Vec3<F>& wo, const Vec3<F>& wi) const {
    return reflectance * select(wo.z > 0 && wi.z > 0, F(1 / pi), F(0.0f));
  }
  F pdf(const Vec3<F>& wo, const Vec3<F>& wi) const { return select(wo.z > 0, cosine_hemisphere_pdf(wi.z), F(0.0f)); }
  BsdfSample<F> sample(const Vec3<F>& wo, const F&, const Vec2<F>& u, TransportMode) const {
    const Vec3<F> wi = has_fault(Fault::uniform_diffuse) ? square_to_cone(u, F(1.0f)) : square_to_cosine_hemisphere(u);
    return {wi, reflectance, cosine_hemisphere_pdf(wi.z), F(1.0f), as_mask<F>(false), wo.z > 0 && wi.z > 0};
  }
};

}  // namespace photonproof::inline renderer_bsdfs
