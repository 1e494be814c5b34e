// Lambertian reflection, one-sided: f = reflectance / pi above the surface, 0 below.
#pragma once

#include <optional>

#include "renderer/bsdf_sample.h"
#include "renderer/warp.h"

namespace photonproof {

struct DiffuseBsdf {
  Rgb reflectance;

  Rgb eval(const Vec3f& wo, const Vec3f& wi) const { return wo.z > 0 && wi.z > 0 ? reflectance * (1 / pi) : Rgb(0.0f); }
  float pdf(const Vec3f& wo, const Vec3f& wi) const { return wo.z > 0 ? cosine_hemisphere_pdf(wi.z) : 0; }

  std::optional<BsdfSample> sample(const Vec3f& wo, float, const Vec2<float>& u, TransportMode) const {
    if (wo.z <= 0) return std::nullopt;
    const Vec3f wi = square_to_cosine_hemisphere(u);
    if (wi.z <= 0) return std::nullopt;
    return BsdfSample{wi, reflectance, cosine_hemisphere_pdf(wi.z), false, 1};
  }
};

}  // namespace photonproof
