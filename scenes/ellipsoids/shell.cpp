#include "scenes/ellipsoids/shell.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace photonproof::inline scenes_ellipsoids {
namespace {

using Triangle = TriangleMesh::Triangle;

struct Corners {
  std::vector<Vec3d> at;
  std::vector<Triangle> triangles;

  void add_ring(double height, double first_degrees, int count) {
    const double radius = std::sqrt(1 - height * height);
    for (int i = 0; i < count; ++i) {
      const double angle = (first_degrees + 360.0 * i / count) * std::numbers::pi / 180;
      at.push_back({radius * std::cos(angle), height, radius * std::sin(angle)});
    }
  }
};

Corners icosahedron() {
  const double height = 1 / std::sqrt(5.0);
  Corners c;
  c.at.push_back({0, -1, 0});
  c.add_ring(-height, 36, 5);
  c.add_ring(height, 72, 5);
  c.at.push_back({0, 1, 0});
  for (std::uint32_t i = 0; i < 5; ++i) {
    const std::uint32_t low = 1 + i, low2 = 1 + (i + 1) % 5, high = 6 + i, high2 = 6 + (i + 1) % 5;
    c.triangles.insert(c.triangles.end(),
                       {Triangle{0, low, low2}, {low, high, low2}, {low2, high, high2}, {high, 11, high2}});
  }
  return c;
}

Corners cube() {
  Corners c;
  for (int i = 0; i < 8; ++i) c.at.push_back({i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0});
  constexpr std::array<std::array<std::uint32_t, 4>, 6> sides{
      {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
  for (const auto& s : sides) c.triangles.insert(c.triangles.end(), {Triangle{s[0], s[1], s[2]}, {s[0], s[2], s[3]}});
  return c;
}

/// Four rings of nine corners, at heights of sines of 54 and 18 degrees, and the poles.
Corners globe() {
  constexpr std::uint32_t around = 9, rings = 4;
  Corners c;
  for (const double degrees : {-54.0, -18.0, 18.0, 54.0})
    c.add_ring(std::sin(degrees * std::numbers::pi / 180), -50, around);
  c.at.push_back({0, -1, 0});
  c.at.push_back({0, 1, 0});
  const std::uint32_t south = around * rings, north = south + 1;
  for (std::uint32_t i = 0; i < around; ++i) {
    const std::uint32_t next = (i + 1) % around;
    c.triangles.push_back({south, i, next});
    for (std::uint32_t low = 0; low + around < south; low += around) {
      const std::uint32_t high = low + around;
      c.triangles.insert(c.triangles.end(),
                         {Triangle{low + i, high + i, low + next}, {low + next, high + i, high + next}});
    }
    c.triangles.push_back({south - around + i, north, south - around + next});
  }
  return c;
}

}  // namespace

TriangleMesh unit_shell(Shell shell) {
  const Corners c = shell == Shell::box ? cube() : shell == Shell::uv_sphere ? globe() : icosahedron();
  double least = 1e300;
  for (const Triangle& t : c.triangles) {
    for (const std::uint32_t k : t) least = std::min(least, length(c.at[k]));
    least = std::min(least, length((c.at[t[0]] + c.at[t[1]] + c.at[t[2]]) / 3));
  }
  TriangleMesh mesh;
  mesh.resize_positions(c.at.size());
  for (std::size_t i = 0; i < c.at.size(); ++i) mesh.positions[i] = Vec3f(c.at[i] / least);
  mesh.triangles = c.triangles;
  return mesh;
}

}  // namespace photonproof::inline scenes_ellipsoids
