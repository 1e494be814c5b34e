// Smooth dielectric: reflection and refraction chosen by Fresnel reflectance. The normal points to the exterior.
#pragma once

#include "renderer/bsdfs/bsdf_sample.h"
#include "renderer/bsdfs/fresnel.h"

namespace photonproof::inline renderer_bsdfs {

template <class F>
struct DielectricBsdf {
  static constexpr bool has_smooth = false;
  static constexpr bool is_lambertian = false;
  static constexpr bool lets_light_through = true;
  F eta;  ///< interior ior / exterior ior
  Vec3<F> reflectance, transmittance;

  Vec3<F> eval(const Vec3<F>&, const Vec3<F>&) const { return Vec3<F>(F(0.0f)); }
  F pdf(const Vec3<F>&, const Vec3<F>&) const { return F(0.0f); }

  BsdfSample<F> sample(const Vec3<F>& wo, const F& u, const Vec2<F>&, TransportMode mode) const {
    const Mask<F> outside = wo.z > 0;
    const F eta_path = select(outside, eta, 1 / eta);  // side entered over side left
    const F to_path = 1 / eta_path;
    const DielectricFresnel<F> fresnel = fresnel_dielectric(lane_abs(wo.z), eta_path);
    const Mask<F> reflects = u < fresnel.reflectance;
    const Vec3<F> reflected{-wo.x, -wo.y, wo.z};
    const Vec3<F> refracted{-wo.x * to_path, -wo.y * to_path,
                            select(outside, -fresnel.cos_transmit, fresnel.cos_transmit)};
    // Refraction keeps radiance over ior squared; wo is on the side the radiance goes to.
    const F scale = mode == TransportMode::radiance ? F(to_path * to_path) : F(1.0f);
    return {select(reflects, reflected, refracted),
            select(reflects, reflectance, transmittance * scale),
            select(reflects, fresnel.reflectance, 1 - fresnel.reflectance),
            select(reflects, F(1.0f), eta_path),
            as_mask<F>(true),
            wo.z != 0};
  }

  /// The probability of reflection: where u < it.
  F reflected_share(const Vec3<F>& wo) const {
    return fresnel_dielectric(lane_abs(wo.z), select(wo.z > 0, eta, F(1 / eta))).reflectance;
  }
};

}  // namespace photonproof::inline renderer_bsdfs
