// Maps from the unit square to the directions and points that estimators sample, with their densities.
#pragma once

#include <cmath>
#include <numbers>

#include "renderer/lanes/lane_trig.h"

namespace photonproof::inline renderer_lanes {

inline constexpr float pi = std::numbers::pi_v<float>;
inline constexpr double pi_d = std::numbers::pi;

/// The angle of (x, y) in turns, [0, 1).
inline float turn_of(float x, float y) {
  const float turn = std::atan2(y, x) / (2 * pi);
  return turn < 0 ? turn + 1 : turn;
}

/// Orthonormal frame around a unit normal (Duff et al. 2017, "Building an Orthonormal Basis, Revisited").
template <class F>
struct Frame {
  Vec3<F> s, t, n;

  explicit Frame(const Vec3<F>& normal) : n(normal) {
    const F sign = lane_copysign(F(1.0f), n.z);
    const F a = -1.0f / (sign + n.z);
    const F b = n.x * n.y * a;
    s = {1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x};
    t = {b, sign + n.y * n.y * a, -n.y};
  }
  /// `tangent` is unit and perpendicular to the normal.
  Frame(const Vec3<F>& normal, const Vec3<F>& tangent) : s(tangent), t(cross(normal, tangent)), n(normal) {}
  Vec3<F> to_local(const Vec3<F>& v) const { return {dot(v, s), dot(v, t), dot(v, n)}; }
  Vec3<F> to_world(const Vec3<F>& v) const { return advance(advance(n * v.z, v.y, t), v.x, s); }
};

/// Uniform on the unit disc, area-preserving and continuous (Shirley and Chiu 1997). Density 1/pi.
template <class F>
Vec2<F> square_to_disc(const Vec2<F>& u) {
  const F a = 2 * u.x - 1;
  const F b = 2 * u.y - 1;
  const Mask<F> wide = lane_abs(a) > lane_abs(b);
  const F radius = select(wide, a, b);
  const F other = select(wide, b, a);
  const SinCos<F> angle = sincos_quarter(F((pi / 4) * (other / select(radius == 0, F(1.0f), radius))));
  return {radius * select(wide, angle.cos, angle.sin), radius * select(wide, angle.sin, angle.cos)};
}

/// Direction about +z with density cos(theta)/pi per solid angle.
template <class F>
Vec3<F> square_to_cosine_hemisphere(const Vec2<F>& u) {
  const Vec2<F> d = square_to_disc(u);
  return {d.x, d.y, lane_sqrt(lane_max(F(1 - d.x * d.x - d.y * d.y), F(0.0f)))};
}
template <class F>
F cosine_hemisphere_pdf(const F& cos_theta) {
  return lane_max(cos_theta, F(0.0f)) * (1 / pi);
}

/// Direction with density 1/(4 pi) per solid angle.
template <class F>
Vec3<F> square_to_sphere(const Vec2<F>& u) {
  const F z = 1 - 2 * u.x;
  const F r = lane_sqrt(lane_max(F(1 - z * z), F(0.0f)));
  const SinCos<F> phi = sincos_turn(u.y);
  return {r * phi.cos, r * phi.sin, z};
}

/// Direction about +z within the cone whose 1 - cos(angle) is given; density 1 / (2 pi one_minus_cos) per solid angle.
template <class F>
Vec3<F> square_to_cone(const Vec2<F>& u, const F& one_minus_cos) {
  const F drop = u.x * one_minus_cos;  // 1 - cos(theta), kept apart: narrow cones lose it in cos(theta)
  const F sin_theta = lane_sqrt(lane_max(F(drop * (2 - drop)), F(0.0f)));
  const SinCos<F> phi = sincos_turn(u.y);
  return {sin_theta * phi.cos, sin_theta * phi.sin, 1 - drop};
}

}  // namespace photonproof::inline renderer_lanes
