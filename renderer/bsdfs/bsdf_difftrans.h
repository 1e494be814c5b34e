// Lambertian transmission, the same from both sides: f = transmittance / pi where the directions lie on opposite sides,
// 0 elsewhere. The model of Mitsuba 0.6's plugin of that name.
#pragma once

#include "renderer/bsdfs/bsdf_sample.h"
#include "renderer/lanes/warp.h"

namespace photonproof::inline renderer_bsdfs {

template <class F>
struct DiffuseTransmitterBsdf {
  static constexpr bool has_smooth = true;
  static constexpr bool is_lambertian = false;
  static constexpr bool lets_light_through = true;
  Vec3<F> transmittance;

  Vec3<F> eval(const Vec3<F>& wo, const Vec3<F>& wi) const {
    return transmittance * select(wo.z * wi.z < 0, F(1 / pi), F(0.0f));
  }
  F pdf(const Vec3<F>& wo, const Vec3<F>& wi) const {
    return select(wo.z * wi.z < 0, cosine_hemisphere_pdf(lane_abs(wi.z)), F(0.0f));
  }
  BsdfSample<F> sample(const Vec3<F>& wo, const F&, const Vec2<F>& u, TransportMode) const {
    const Vec3<F> up = square_to_cosine_hemisphere(u);
    const Vec3<F> wi = select(wo.z > 0, Vec3<F>(-up), up);
    return {wi, transmittance, cosine_hemisphere_pdf(up.z), F(1.0f), as_mask<F>(false), wo.z != 0 && up.z > 0};
  }
};

}  // namespace photonproof::inline renderer_bsdfs
