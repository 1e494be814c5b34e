// Smooth conductor, one-sided. Without a complex ior it reflects the same at every angle.
#pragma once

#include <optional>

#include "renderer/bsdf_sample.h"
#include "renderer/fresnel.h"

namespace photonproof {

struct ConductorBsdf {
  Rgb reflectance;
  bool has_ior = false;
  Rgb eta{1.0f}, k{0.0f};

  Rgb eval(const Vec3f&, const Vec3f&) const { return Rgb(0.0f); }
  float pdf(const Vec3f&, const Vec3f&) const { return 0; }

  std::optional<BsdfSample> sample(const Vec3f& wo, float, const Vec2<float>&, TransportMode) const {
    if (wo.z <= 0) return std::nullopt;
    const Rgb weight = has_ior ? reflectance * fresnel_conductor(wo.z, eta, k) : reflectance;
    return BsdfSample{{-wo.x, -wo.y, wo.z}, weight, 1, true, 1};
  }
};

}  // namespace photonproof
