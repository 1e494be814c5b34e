#include "renderer/media/phase.h"

#include <algorithm>

#include "renderer/lanes/warp.h"

namespace photonproof::inline renderer_media {
namespace {

Vec3f turned(const Vec3f& travel, float cos_theta, float u) {
  const float sin_theta = std::sqrt(std::max(0.0f, 1 - cos_theta * cos_theta));
  const SinCos<float> phi = sincos_turn(u);
  return normalize(Frame<float>(travel).to_world({sin_theta * phi.cos, sin_theta * phi.sin, cos_theta}));
}

constexpr float below_one = 0x1.fffffep-1f;

}  // namespace

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
  return turned(travel, cos_theta, u.y);
}

float Rayleigh::eval(const Vec3f& travel, const Vec3f& wi) const {
  const float cos_theta = dot(travel, wi);
  return 3 / (16 * pi) * (1 + cos_theta * cos_theta);
}

/// The share of directions with a cosine below c is (c^3 + 3 c + 4) / 8. Let a^3 = z + sqrt(z^2 + 1) and z = 4 u - 2.
/// Then c = a - 1/a solves c^3 + 3 c = a^3 - 1/a^3 = 2 z = 8 u - 4.
Vec3f Rayleigh::sample(const Vec3f& travel, const Vec2<float>& u) const {
  const float z = 4 * u.x - 2, a = std::cbrt(z + std::sqrt(z * z + 1));
  return turned(travel, std::clamp(a - 1 / a, -1.0f, 1.0f), u.y);
}

float PhaseFunction::eval(const Vec3f& travel, const Vec3f& wi) const {
  const auto of = [&](const Lobe& lobe) { return std::visit([&](const auto& f) { return f.eval(travel, wi); }, lobe); };
  if (!(weight > 0)) return of(first);
  return (1 - weight) * of(first) + weight * of(second);
}

/// A lobe is chosen by u.x, which is then stretched over the chosen one's part.
Vec3f PhaseFunction::sample(const Vec3f& travel, const Vec2<float>& u) const {
  const bool takes_second = u.x < weight;
  const float of_lobe = takes_second ? u.x / weight : weight > 0 ? (u.x - weight) / (1 - weight) : u.x;
  return std::visit(
      [&](const auto& f) {
        return f.sample(travel, {std::min(of_lobe, below_one), u.y});
      },
      takes_second ? second : first);
}

}  // namespace photonproof::inline renderer_media
