// Maps from the unit square to the directions and points that estimators draw, with their densities.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenes/vec.h"

namespace photonproof {

inline constexpr float pi = std::numbers::pi_v<float>;

/// Orthonormal frame around a unit normal (Duff et al. 2017, "Building an Orthonormal Basis, Revisited").
struct Frame {
  Vec3f s, t, n;

  explicit Frame(const Vec3f& normal) : n(normal) {
    const float sign = std::copysign(1.0f, n.z);
    const float a = -1.0f / (sign + n.z);
    const float b = n.x * n.y * a;
    s = {1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x};
    t = {b, sign + n.y * n.y * a, -n.y};
  }
  Vec3f to_local(const Vec3f& v) const { return {dot(v, s), dot(v, t), dot(v, n)}; }
  Vec3f to_world(const Vec3f& v) const { return s * v.x + t * v.y + n * v.z; }
};

/// Uniform on the unit disc, area-preserving and continuous (Shirley and Chiu 1997). Density 1/pi.
inline Vec2<float> square_to_disc(const Vec2<float>& u) {
  const float a = 2 * u.x - 1;
  const float b = 2 * u.y - 1;
  if (a == 0 && b == 0) return {0, 0};
  const bool wide = std::abs(a) > std::abs(b);
  const float radius = wide ? a : b;
  const float angle = wide ? (pi / 4) * (b / a) : (pi / 2) - (pi / 4) * (a / b);
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

/// Direction about +z with density cos(theta)/pi per solid angle.
inline Vec3f square_to_cosine_hemisphere(const Vec2<float>& u) {
  const Vec2<float> d = square_to_disc(u);
  return {d.x, d.y, std::sqrt(std::max(0.0f, 1 - d.x * d.x - d.y * d.y))};
}
inline float cosine_hemisphere_pdf(float cos_theta) { return std::max(0.0f, cos_theta) / pi; }

/// Direction with density 1/(4 pi) per solid angle.
inline Vec3f square_to_sphere(const Vec2<float>& u) {
  const float z = 1 - 2 * u.x;
  const float r = std::sqrt(std::max(0.0f, 1 - z * z));
  const float phi = 2 * pi * u.y;
  return {r * std::cos(phi), r * std::sin(phi), z};
}

/// Direction about +z within the cone whose 1 - cos(angle) is given; density 1 / (2 pi one_minus_cos) per solid angle.
inline Vec3f square_to_cone(const Vec2<float>& u, float one_minus_cos) {
  const float drop = u.x * one_minus_cos;  // 1 - cos(theta), kept apart: narrow cones lose it in cos(theta)
  const float sin_theta = std::sqrt(std::max(0.0f, drop * (2 - drop)));
  const float phi = 2 * pi * u.y;
  return {sin_theta * std::cos(phi), sin_theta * std::sin(phi), 1 - drop};
}

}  // namespace photonproof
