// Smooth dielectric: reflection and refraction chosen by Fresnel reflectance. The normal points to the exterior.
#pragma once

#include <optional>

#include "renderer/bsdf_sample.h"
#include "renderer/fresnel.h"

namespace photonproof {

struct DielectricBsdf {
  float eta = 1.5f;  ///< interior ior / exterior ior
  Rgb reflectance{1.0f};
  Rgb transmittance{1.0f};

  Rgb eval(const Vec3f&, const Vec3f&) const { return Rgb(0.0f); }
  float pdf(const Vec3f&, const Vec3f&) const { return 0; }

  std::optional<BsdfSample> sample(const Vec3f& wo, float u, const Vec2<float>&, TransportMode mode) const {
    const bool outside = wo.z > 0;
    const float eta_path = outside ? eta : 1 / eta;  // side entered over side left
    const DielectricFresnel fresnel = fresnel_dielectric(std::abs(wo.z), eta_path);
    if (u < fresnel.reflectance) {
      return BsdfSample{{-wo.x, -wo.y, wo.z}, reflectance, fresnel.reflectance, true, 1};
    }
    const float cos_transmit = outside ? -fresnel.cos_transmit : fresnel.cos_transmit;
    const Vec3f wi{-wo.x / eta_path, -wo.y / eta_path, cos_transmit};
    // Radiance over ior squared is what refraction keeps; wo is on the side the radiance goes to.
    const float scale = mode == TransportMode::radiance ? 1 / (eta_path * eta_path) : 1;
    return BsdfSample{wi, transmittance * scale, 1 - fresnel.reflectance, true, eta_path};
  }
};

}  // namespace photonproof
