#include "reference/closed_forms/closed_forms_lights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "scenes/meshes/convex_clip.h"

namespace photonproof::inline reference_closed_forms {

double irradiance_of_point(double intensity, const Vec3d& light, const SurfacePoint& at) {
  const Vec3d to_light = light - at.position;
  const double d2 = length_squared(to_light);
  return intensity * std::max(0.0, dot(at.normal, to_light)) / (d2 * std::sqrt(d2));
}

double irradiance_of_polygon(double radiance, std::span<const Vec3d> vertices, const SurfacePoint& at) {
  const Vec3d face = cross(vertices[1] - vertices[0], vertices[2] - vertices[0]);
  if (dot(face, at.position - vertices[0]) <= 0) return 0;
  const std::array<HalfSpace, 1> above{{{-at.normal, -dot(at.normal, at.position)}}};
  const std::vector<Vec3d> visible = clip_polygon({vertices.begin(), vertices.end()}, above);
  double sum = 0;
  for (std::size_t i = 0; i < visible.size(); ++i) {
    const Vec3d a = visible[i] - at.position;
    const Vec3d b = visible[(i + 1) % visible.size()] - at.position;
    const Vec3d normal = cross(a, b);
    const double sine = length(normal);
    if (sine > 0) sum += std::atan2(sine, dot(a, b)) * dot(at.normal, normal) / sine;
  }
  // Counter-clockwise from the point's side is clockwise around it, which the formula counts negative.
  return 0.5 * radiance * std::abs(sum);
}

double irradiance_of_rectangle_corner(double radiance, double a, double b, double h) {
  const double A = a / h, B = b / h;
  const double along_a = std::sqrt(1 + A * A), along_b = std::sqrt(1 + B * B);
  return 0.5 * radiance * (A / along_a * std::atan(B / along_a) + B / along_b * std::atan(A / along_b));
}

double irradiance_of_sphere(double radiance, const Vec3d& center, double radius, const SurfacePoint& at) {
  const Vec3d to_light = center - at.position;
  const double d2 = length_squared(to_light);
  return std::numbers::pi * radiance * radius * radius / d2 * dot(at.normal, to_light) / std::sqrt(d2);
}

double irradiance_of_cylinder(double radiance, const Vec3d& p0, const Vec3d& p1, double radius,
                              const SurfacePoint& at) {
  // The visible side ends where a tangent from the point touches: acos(R / rho) from the point's own azimuth, at the
  // distance rho from the axis. The outside of a convex body hides no part of that side.
  constexpr int along = 4, around = 16;
  const double gauss = 0.5 / std::sqrt(3.0);
  const auto node = [&](int i) { return i / 2 + 0.5 + (i % 2 == 0 ? -gauss : gauss); };
  const Vec3d axis = p1 - p0, off = at.position - p0, y = normalize(axis), across = off - y * dot(off, y);
  const double rho = length(across), reach = std::acos(radius / rho);
  const Vec3d towards = across / rho, beside = cross(y, towards);
  double sum = 0;
  for (int j = 0; j < 2 * around; ++j) {
    const double phi = reach * (2 * node(j) / around - 1);
    const Vec3d normal = towards * std::cos(phi) + beside * std::sin(phi);
    for (int i = 0; i < 2 * along; ++i) {
      const Vec3d d = p0 + axis * (node(i) / along) + normal * radius - at.position;
      const double d2 = length_squared(d);
      sum += dot(at.normal, d) * -dot(normal, d) / (d2 * d2);
    }
  }
  return radiance * sum * (2 * reach * radius * length(axis) / (4 * along * around));
}

double irradiance_of_spot(double intensity, const Vec3d& light, const Vec3d& axis, const SpotCone& cone,
                          const SurfacePoint& at) {
  const double angle = std::acos(std::clamp(dot(normalize(at.position - light), axis), -1.0, 1.0));
  const double falloff = std::clamp((cone.cutoff - angle) / (cone.cutoff - cone.beam), 0.0, 1.0);
  return falloff * irradiance_of_point(intensity, light, at);
}

double irradiance_of_beam(double irradiance, const Vec3d& direction, const Vec3d& normal) {
  return irradiance * std::max(0.0, -dot(direction, normal));
}

double irradiance_of_uniform_sky(double radiance) { return std::numbers::pi * radiance; }

double irradiance_of_parallel_disc(double radiance, double radius, double height, double offset) {
  // Without the division by `offset` of Howell's H = h/a and R = r/a, so that the axis is no special case.
  const double a2 = offset * offset, h2 = height * height, r2 = radius * radius;
  const double z = a2 + h2 + r2;
  return 0.5 * std::numbers::pi * radiance * (1 - (a2 + h2 - r2) / std::sqrt(z * z - 4 * a2 * r2));
}

}  // namespace photonproof::inline reference_closed_forms
