// Surfaces of lights in coordinates (u, v) in the unit square, in double precision and from the shapes' equations; test
// code only. Samples are binned in these coordinates, where densities are smooth: a silhouette or an outline is always
// a border of the square.
#pragma once

#include <functional>
#include <numbers>
#include <vector>

#include "renderer/lights/light.h"

namespace photonproof::test {

struct PatchPoint {
  Vec3d p, n, along;       ///< n: unit, on the emitting side. The tangent `along` is a unit vector.
  double area = 0;         ///< Area per du dv.
  double solid_angle = 0;  ///< Solid angle per du dv from the viewing point; 0 if it follows from the area.
  std::uint32_t triangle = 0;
};

struct Patch {
  std::function<PatchPoint(double u, double v)> at;
  std::function<Vec2<double>(const Vec3d& p)> uv;
  double area = 0;
  Vec3d facing{0.0};  ///< normal of a flat patch
};

/// The part of a light that shines on a point, and its share of the light's samples.
struct Seen {
  std::vector<Patch> patches;
  double share = 0;
  bool share_known = true;  ///< otherwise `share` is an upper bound
  int finer = 1;            ///< factor of subdivision of cells a side, for integrals
};

inline double turn(double y, double x) {
  const double t = std::atan2(y, x) / (2 * std::numbers::pi);
  return t < 0 ? t + 1 : t;
}
inline Vec3d any_across(const Vec3d& n) {
  return normalize(cross(std::abs(n.x) < 0.6 ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0), n));
}

/// The solution (a, b) of q = a u + b v.
inline Vec2<double> in_basis_of(const Vec3d& q, const Vec3d& u, const Vec3d& v) {
  const Vec3d n = cross(u, v);
  const double nn = dot(n, n);
  return {dot(cross(q, v), n) / nn, dot(cross(u, q), n) / nn};
}

inline Patch quad_patch(const Vec3d& corner, const Vec3d& u, const Vec3d& v, const Vec3d& n) {
  const double area = length(cross(u, v));
  return {[=](double a, double b) {
            return PatchPoint{corner + u * a + v * b, n, normalize(u), area};
          },
          [=](const Vec3d& p) { return in_basis_of(p - corner, u, v); }, area, n};
}

/// Patch with u the squared distance from the centre in half axes, v in turns.
inline Patch disk_patch(const Vec3d& center, const Vec3d& u, const Vec3d& v, const Vec3d& n) {
  const double area = std::numbers::pi * length(cross(u, v));
  return {[=](double a, double b) {
            const double r = std::sqrt(a), phi = 2 * std::numbers::pi * b;
            return PatchPoint{center + u * (r * std::cos(phi)) + v * (r * std::sin(phi)), n, normalize(u), area};
          },
          [=](const Vec3d& p) {
            const Vec2<double> d = in_basis_of(p - center, u, v);
            return Vec2<double>{d.x * d.x + d.y * d.y, turn(d.y, d.x)};
          },
          area, n};
}

/// Patch with u the distance from a towards the opposite side, v the position along it.
inline Patch triangle_patch(const Vec3d& a, const Vec3d& b, const Vec3d& c, double sign, std::uint32_t index) {
  const Vec3d ab = b - a, ac = c - a, n = normalize(cross(ab, ac)) * sign;
  const double twice = length(cross(ab, ac));
  return {[=](double s, double t) {
            return PatchPoint{a + ab * (s * (1 - t)) + ac * (s * t), n, normalize(ab), twice * s, 0, index};
          },
          [=](const Vec3d& p) {
            const Vec2<double> w = in_basis_of(p - a, ab, ac);
            const double s = w.x + w.y;
            return Vec2<double>{s, s > 0 ? w.y / s : 0};
          },
          twice / 2, n};
}

/// The zone between two heights along the axis; the poles are at -1 and 1 (Archimedes: equal heights, equal areas).
inline Patch sphere_zone(const Vec3d& center, double radius, double sign, const Vec3d& axis, double low, double high) {
  const Vec3d s = any_across(axis), t = cross(axis, s);
  const double area = 2 * std::numbers::pi * radius * radius * (high - low);
  return {[=](double a, double b) {
            const double z = low + (high - low) * a, r = std::sqrt(1 - z * z), phi = 2 * std::numbers::pi * b;
            const Vec3d out = s * (r * std::cos(phi)) + t * (r * std::sin(phi)) + axis * z;
            return PatchPoint{center + out * radius, out * sign, t * std::cos(phi) - s * std::sin(phi), area};
          },
          [=](const Vec3d& p) {
            const Vec3d out = normalize(p - center);
            return Vec2<double>{(dot(out, axis) - low) / (high - low), turn(dot(out, t), dot(out, s))};
          },
          area};
}

/// The cap of a sphere that p sees, in equal solid angles from p.
inline Patch sphere_cap(const Vec3d& center, double radius, const Vec3d& p) {
  const double distance = length(center - p), ratio2 = radius * radius / (distance * distance);
  const Vec3d axis = (center - p) / distance, s = any_across(axis), t = cross(axis, s);
  const double reach = ratio2 / (1 + std::sqrt(1 - ratio2));  // 1 - cos of the cone's half-angle
  return {[=](double a, double b) {
            const double versine = a * reach, sin2 = versine * (2 - versine), phi = 2 * std::numbers::pi * b;
            const Vec3d across = s * std::cos(phi) + t * std::sin(phi);
            const Vec3d d = axis * (1 - versine) + across * std::sqrt(sin2);
            const double far =
                distance * (1 - versine) - std::sqrt(radius * radius - distance * distance * sin2);  // near crossing
            const Vec3d q = p + d * far;
            return PatchPoint{q, (q - center) / radius, across, 0, 2 * std::numbers::pi * reach};
          },
          [=](const Vec3d& q) {
            const Vec3d d = normalize(q - p), apart = d - axis;
            return Vec2<double>{dot(apart, apart) / 2 / reach, turn(dot(d, t), dot(d, s))};
          },
          0};
}

/// The sector between two angles, in radians about the axis from `start`, unit and perpendicular to it.
inline Patch cylinder_sector(const Vec3d& base, const Vec3d& axis, const Vec3d& start, double radius, double sign,
                             double from, double to) {
  const Vec3d side = cross(normalize(axis), start);
  const double area = radius * (to - from) * length(axis);
  return {[=](double a, double b) {
            const double phi = from + (to - from) * a;
            const Vec3d out = start * std::cos(phi) + side * std::sin(phi);
            return PatchPoint{base + out * radius + axis * b, out * sign, normalize(axis), area};
          },
          [=](const Vec3d& p) {
            const Vec3d q = p - base;
            double phi = std::atan2(dot(q, side), dot(q, start));
            // Picks the turn that is nearest to the sector's middle.
            phi += 2 * std::numbers::pi * std::round(((from + to) / 2 - phi) / (2 * std::numbers::pi));
            return Vec2<double>{(phi - from) / (to - from), dot(q, axis) / dot(axis, axis)};
          },
          area};
}

}  // namespace photonproof::test
