// Smooth conductor, one-sided. Without a complex ior it reflects the same at every angle.
#pragma once

#include "renderer/bsdfs/bsdf_sample.h"
#include "renderer/bsdfs/fresnel.h"

namespace photonproof::inline renderer_bsdfs {

template <class F>
struct ConductorBsdf {
  static constexpr bool has_smooth = false;
  static constexpr bool is_lambertian = false;
  static constexpr bool lets_light_through = false;
  Vec3<F> reflectance;
  F has_ior{0.0f};  ///< 1 or 0
  Vec3<F> eta, k;

  Vec3<F> eval(const Vec3<F>&, const Vec3<F>&) const { return Vec3<F>(F(0.0f)); }
  F pdf(const Vec3<F>&, const Vec3<F>&) const { return F(0.0f); }

  BsdfSample<F> sample(const Vec3<F>& wo, const F&, const Vec2<F>&, TransportMode) const {
    const Mask<F> with_ior = has_ior > 0;
    Vec3<F> weight = reflectance;
    if (any(with_ior)) weight = select(with_ior, reflectance * fresnel_conductor(wo.z, eta, k), reflectance);
    return {{-wo.x, -wo.y, wo.z}, weight, F(1.0f), F(1.0f), as_mask<F>(true), wo.z > 0};
  }
};

}  // namespace photonproof::inline renderer_bsdfs
