// Surfaces of lights in coordinates of the angles that they subtend from a point; test code only. There the density of
// samples from nearby is smooth. Jacobians convert densities to these coordinates.
#pragma once

#include <array>

#include "renderer/light_sampling/test_light_patches.h"

namespace photonproof::test {

/// A flat outline cut into chords. `chord(y)` gives the start and end of the chord at height y, from the foot of p.
struct Outline {
  Vec3d along, up;
  double low, high;  ///< heights, from the foot of p
  std::function<std::array<double, 2>(double y)> chord;
};

/// A patch with u the angle of the chord and v that of the point on it. p lies `height` in front of the plane.
inline Patch angle_patch(const Vec3d& p, double height, const Vec3d& n, const Outline& o, double area,
                         std::uint32_t triangle = 0) {
  struct Point {
    double y, d, low, high;
  };
  const double first = std::atan2(o.low, height), wide = std::atan2(o.high, height) - first;
  const auto chord_at = [=](double y) {
    const double d = std::hypot(height, y);
    const auto [low, high] = o.chord(y);
    return Point{y, d, std::atan2(low, d), std::atan2(high, d)};
  };
  return {[=](double a, double b) {
            const double alpha = first + a * wide;
            const Point c = chord_at(height * std::tan(alpha));
            const double beta = c.low + b * (c.high - c.low), x = c.d * std::tan(beta);
            const double du = height / std::pow(std::cos(alpha), 2) * wide;
            const double dv = c.d / std::pow(std::cos(beta), 2) * (c.high - c.low);
            const double far = std::hypot(c.d, x);
            return PatchPoint{p - n * height + o.up * c.y + o.along * x, n,       o.along, du * dv,
                              du * dv * height / (far * far * far),      triangle};
          },
          [=](const Vec3d& q) {
            const Point c = chord_at(dot(q - p, o.up));
            const double beta = std::atan2(dot(q - p, o.along), c.d);
            return Vec2<double>{(std::atan2(c.y, height) - first) / wide, (beta - c.low) / (c.high - c.low)};
          },
          area, n};
}

/// Chords parallel to `edge`, which starts at `corner`; they shift by `shift` and grow by `growth` up to `other`.
inline Outline chords_along(const Vec3d& p, const Vec3d& corner, const Vec3d& edge, const Vec3d& other, double growth) {
  const Vec3d along = normalize(edge), up = normalize(other - along * dot(other, along));
  const double x = dot(corner - p, along), y = dot(corner - p, up), high = dot(other, up), shift = dot(other, along);
  return {along, up, y, y + high, [=, reach = length(edge)](double at) {
            const double t = (at - y) / high;
            return std::array<double, 2>{x + shift * t, x + shift * t + reach * (1 + growth * t)};
          }};
}

/// Distance of the foot of p from [low, high].
inline double beside(const Outline& o) { return std::max({o.low, -o.high, 0.0}); }

inline Patch quad_from(const Vec3d& p, const Vec3d& corner, const Vec3d& u, const Vec3d& v, const Vec3d& n) {
  const Outline along_u = chords_along(p, corner, u, v, 0), along_v = chords_along(p, corner, v, u, 0);
  return angle_patch(p, dot(p - corner, n), n, beside(along_v) > beside(along_u) ? along_v : along_u,
                     length(cross(u, v)));
}

inline Patch triangle_from(const Vec3d& p, const std::array<Vec3d, 3>& corner, const Vec3d& n, std::uint32_t index) {
  Outline best;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3d& a = corner[i];
    const Outline o = chords_along(p, a, corner[(i + 1) % 3] - a, corner[(i + 2) % 3] - a, -1);
    if (i == 0 || o.low > best.low) best = o;
  }
  return angle_patch(p, dot(p - corner[0], n), n, best, length(cross(corner[1] - corner[0], corner[2] - corner[0])) / 2,
                     index);
}

/// The patch of an ellipse; chords run across the direction towards p.
inline Patch disk_from(const Vec3d& p, const Vec3d& center, const Vec3d& u, const Vec3d& v, const Vec3d& n) {
  const Vec2<double> at = in_basis_of(p - center, u, v);
  const double turned = std::atan2(at.x, at.y);
  const Vec3d towards = u * std::sin(turned) + v * std::cos(turned),
              across = u * std::cos(turned) - v * std::sin(turned);
  const Vec3d along = normalize(across), up = normalize(towards - along * dot(towards, along));
  const double x = dot(center - p, along), y = dot(center - p, up), reach = dot(towards, up);
  const double shift = dot(towards, along), half = length(across);
  const Outline o{along, up, y - reach, y + reach, [=](double height) {
                    const double t = (height - y) / reach, wide = half * std::sqrt(std::max(0.0, 1 - t * t));
                    return std::array<double, 2>{x + shift * t - wide, x + shift * t + wide};
                  }};
  return angle_patch(p, dot(p - center, n), n, o, std::numbers::pi * length(cross(u, v)));
}

/// A whole cylinder for a point p within it. Coordinates are equal steps of the direction across the axis, then of the
/// angle that heights subtend.
inline Patch cylinder_from_within(const Vec3d& p, const Vec3d& base, const Vec3d& axis, double radius) {
  const Vec3d along = normalize(axis), s = any_across(along), t = cross(along, s);
  const double height = dot(p - base, along), whole = length(axis);
  const Vec3d out = p - base - along * height;
  const auto angles = [=](double d) {
    return std::array<double, 2>{std::atan2(-height, d), std::atan2(whole - height, d)};
  };
  return {[=](double a, double b) {
            const double psi = 2 * std::numbers::pi * a;
            const Vec3d d = s * std::cos(psi) + t * std::sin(psi);
            const double nearer = dot(out, d);
            const double far = -nearer + std::sqrt(nearer * nearer + radius * radius - dot(out, out));
            const auto [low, high] = angles(far);
            const double beta = low + b * (high - low);
            return PatchPoint{p + d * far + along * (far * std::tan(beta)), (out + d * far) / -radius, along, 0,
                              2 * std::numbers::pi * (high - low) * std::cos(beta)};
          },
          [=](const Vec3d& q) {
            const Vec3d d = q - p;
            const double x = dot(d, s), y = dot(d, t), across = std::hypot(x, y);
            const auto [low, high] = angles(across);
            return Vec2<double>{turn(y, x), (std::atan2(dot(d, along), across) - low) / (high - low)};
          },
          0};
}

/// The side of a cylinder that p sees from outside. The first coordinate is in equal steps of the angle from p's
/// azimuth, mapped by phi/2 -> atan(stretch tan(phi/2)). The second is in equal steps of the angle that heights
/// subtend.
inline Patch cylinder_from(const Vec3d& p, const Vec3d& base, const Vec3d& axis, double radius, double sign) {
  const Vec3d along = normalize(axis), from_base = p - base;
  const double height = dot(from_base, along), whole = length(axis);
  const Vec3d out = from_base - along * height;
  const double rho = length(out), stretch = (rho + radius) / (rho - radius);
  const Vec3d s = out / rho, t = cross(along, s);
  const double half = std::atan(stretch * std::tan(std::acos(radius / rho) / 2));
  const double first = sign > 0 ? -half : half, last = sign > 0 ? half : std::numbers::pi - half;
  const auto line = [=](double phi) {
    const double d = std::hypot(rho - radius * std::cos(phi), radius * std::sin(phi));
    return std::array<double, 3>{d, std::atan2(-height, d), std::atan2(whole - height, d)};
  };
  return {[=](double a, double b) {
            const double w = first + a * (last - first);
            const double phi = 2 * std::atan2(std::sin(w), stretch * std::cos(w));
            const auto [d, low, high] = line(phi);
            const double beta = low + b * (high - low);
            const Vec3d facing = s * std::cos(phi) + t * std::sin(phi);
            const double far = d / std::cos(beta), to_light = sign * (rho * std::cos(phi) - radius);
            const double c = std::cos(w), r = std::sin(w) / stretch;
            const double dphi = 2 / stretch / (c * c + r * r) * (last - first);
            const double dz = d / std::pow(std::cos(beta), 2) * (high - low);
            const double area = radius * dphi * dz;
            return PatchPoint{base + facing * radius + along * (height + d * std::tan(beta)), facing * sign, along,
                              area, area * to_light / (far * far * far)};
          },
          [=](const Vec3d& q) {
            const Vec3d from = q - base;
            const double phi = std::atan2(dot(from, t), dot(from, s));
            double w = std::atan2(stretch * std::sin(phi / 2), std::cos(phi / 2));
            if (w < first) w += std::numbers::pi;
            const auto [d, low, high] = line(phi);
            return Vec2<double>{(w - first) / (last - first),
                                (std::atan2(dot(from, along) - height, d) - low) / (high - low)};
          },
          0};
}

/// A whole sphere for a point p within it, in equal solid angles about the direction away from the centre.
inline Patch sphere_from_within(const Vec3d& center, double radius, const Vec3d& p) {
  const Vec3d axis = normalize(p - center), s = any_across(axis), t = cross(axis, s);
  return {[=](double a, double b) {
            const double z = 2 * a - 1, phi = 2 * std::numbers::pi * b, r = std::sqrt(1 - z * z);
            const Vec3d d = axis * z + s * (r * std::cos(phi)) + t * (r * std::sin(phi));
            const double along = dot(p - center, d);
            const double far = -along + std::sqrt(along * along + radius * radius - dot(p - center, p - center));
            const Vec3d q = p + d * far;
            return PatchPoint{q, (center - q) / radius, any_across(d), 0, 4 * std::numbers::pi};
          },
          [=](const Vec3d& q) {
            const Vec3d d = normalize(q - p);
            return Vec2<double>{(dot(d, axis) + 1) / 2, turn(dot(d, t), dot(d, s))};
          },
          0};
}

}  // namespace photonproof::test
