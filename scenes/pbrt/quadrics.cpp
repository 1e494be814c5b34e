#include "scenes/pbrt/quadrics.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace photonproof::inline scenes_pbrt {
namespace {

/// The point at (u, v) of pbrt's own parametrisation, and the outward normal.
void point_at(const PbrtQuadric& q, double u, double v, Vec3d& p, Vec3d& n) {
  const double phi = u * q.sweep_degrees * std::numbers::pi / 180, c = std::cos(phi), s = std::sin(phi);
  if (q.kind == PbrtQuadric::Kind::disk) {
    const double r = q.radius + v * (q.inner - q.radius);
    p = {r * c, r * s, q.bottom};
    n = {0, 0, 1};
  } else if (q.kind == PbrtQuadric::Kind::cylinder) {
    p = {q.radius * c, q.radius * s, q.bottom + v * (q.top - q.bottom)};
    n = {c, s, 0};
  } else {
    // v is even in the angle from +z.
    const auto angle = [&](double z) { return std::acos(std::clamp(z / q.radius, -1.0, 1.0)); };
    const double theta = angle(q.bottom) + v * (angle(q.top) - angle(q.bottom));
    n = {std::sin(theta) * c, std::sin(theta) * s, std::cos(theta)};
    p = n * q.radius;
  }
}

}  // namespace

bool PbrtQuadric::is_whole() const {
  if (sweep_degrees < 360 || inner > 0) return false;
  return kind != Kind::sphere || (bottom <= -radius && top >= radius);
}

TriangleMesh triangles_of(const PbrtQuadric& q) {
  const std::uint32_t around = 128, along = q.kind == PbrtQuadric::Kind::sphere ? 64 : 1;
  TriangleMesh mesh;
  mesh.resize_positions((around + 1) * (along + 1));
  for (std::uint32_t j = 0; j <= along; ++j)
    for (std::uint32_t i = 0; i <= around; ++i) {
      const double u = double{1} * i / around, v = double{1} * j / along;
      Vec3d p, n;
      point_at(q, u, v, p, n);
      mesh.positions[j * (around + 1) + i] = Vec3f(p);
      mesh.normals.push_back(Vec3f(n));
      mesh.uvs.push_back({static_cast<float>(u), static_cast<float>(1 - v)});
    }
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if (has_area(mesh.positions, {a, b, c})) mesh.triangles.push_back({a, b, c});
  };
  for (std::uint32_t j = 0; j < along; ++j)
    for (std::uint32_t i = 0; i < around; ++i) {
      // dp/du x dp/dv is the outward normal of all three.
      const std::uint32_t a = j * (around + 1) + i, b = a + 1, c = a + around + 1, d = c + 1;
      add(a, b, d);
      add(a, d, c);
    }
  return mesh;
}

}  // namespace photonproof::inline scenes_pbrt
