#include "renderer/media/phase.h"

#include "renderer/lanes/warp.h"

namespace photonproof::inline renderer_media {

float HenyeyGreenstein::eval(const Vec3f& travel, const Vec3f& wi) const {
  const float spread = 1 + g * g - 2 * g * dot(travel, wi);
  return (1 - g * g) / (4 * pi * spread * std::sqrt(spread));
}

Vec3f HenyeyGreenstein::sample(const Vec3f& travel, const Vec2<float>& u) const {
  float cos_theta = 1 - 2 * u.x;
  if (std::abs(g) > 1e-3f) {  // else the inversion of the distribution divides by nothing
    const float ratio = (1 - g * g) / (1 + g - 2 * g * u.x);
    cos_theta = std::clamp((1 + g * g - ratio * ratio) / (2 * g), -1.0f, 1.0f);
  }
  const float sin_theta = std::sqrt(std::max(0.0f, 1 - cos_theta * cos_theta));
  const SinCos<float> phi = sincos_turn(u.y);
  return normalize(Frame<float>(travel).to_world({sin_theta * phi.cos, sin_theta * phi.sin, cos_theta}));
}

}  // namespace photonproof::inline renderer_media
