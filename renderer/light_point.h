// Isotropic point light: irradiance I cos / d^2.
#pragma once

#include "renderer/light_sample.h"
#include "renderer/warp.h"

namespace photonproof {

struct PointLight {
  Vec3f position;
  Rgb intensity;  ///< W sr^-1

  LightSample sample(const Vec3f& p, const Vec2<float>&) const {
    const Vec3f d = position - p;
    const float distance2 = dot(d, d);
    if (distance2 == 0) return {};
    return {position, Vec3f(0.0f), d / std::sqrt(distance2), intensity / distance2, 1};
  }
  float pdf(const Vec3f&, const Vec3f&, const Vec3f&) const { return 0; }
  Emission emit(const Vec2<float>&, const Vec2<float>& u) const {
    return {position, Vec3f(0.0f), square_to_sphere(u), flux()};
  }
  Rgb flux() const { return intensity * (4 * pi); }
  Rgb emitted_radiance(float) const { return Rgb(0.0f); }
};

}  // namespace photonproof
