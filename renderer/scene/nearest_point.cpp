#include "renderer/scene/nearest_point.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "renderer/shapes/extent.h"

namespace photonproof::inline renderer_scene {
namespace {

/// Vertices of a mesh with more triangles lie close enough to stand for them.
constexpr std::size_t most_triangles_to_look_at = 4096;
constexpr std::size_t triangles_of_a_run = 32;

}  // namespace

void NearestPoint::add(const Vec3d& p) {
  const double d = length(p - to);
  if (!(d < distance)) return;
  distance = d;
  point = p;
}

Vec3d nearest_on_triangle(const Vec3d& p, const Vec3d& a, const Vec3d& u, const Vec3d& v) {
  const Vec3d q = p - a;
  const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), qu = dot(q, u), qv = dot(q, v);
  const double determinant = uu * vv - uv * uv;
  const double s = (qu * vv - qv * uv) / determinant, t = (qv * uu - qu * uv) / determinant;
  if (s >= 0 && t >= 0 && s + t <= 1) return a + u * s + v * t;
  NearestPoint nearest{p};
  const auto on_edge = [&](const Vec3d& from, const Vec3d& along) {
    const double share = dot(p - from, along) / dot(along, along);
    nearest.add(from + along * (share > 0 ? std::min(share, 1.0) : 0.0));
  };
  on_edge(a, u);
  on_edge(a, v);
  on_edge(a + u, v - u);
  return nearest.point;
}

Vec3d nearest_on_parallelogram(const Vec3d& p, const Vec3d& a, const Vec3d& u, const Vec3d& v) {
  NearestPoint nearest{p};
  nearest.add(nearest_on_triangle(p, a, u, v));
  nearest.add(nearest_on_triangle(p, a + u + v, -u, -v));
  return nearest.point;
}

NearestOnMesh::NearestOnMesh(const TriangleMesh& mesh) : mesh_(mesh) {
  for (std::size_t begin = 0; begin < mesh.triangles.size(); begin += triangles_of_a_run) {
    Run run{begin, std::min(begin + triangles_of_a_run, mesh.triangles.size()), {}, {}};
    Extent box;
    for (std::size_t i = run.begin; i < run.end; ++i)
      for (const std::uint32_t vertex : mesh.triangles[i]) box.add(Vec3d(mesh.positions[vertex]));
    run.middle = box.middle();
    run.half = (box.high - box.low) * 0.5;
    runs_.push_back(run);
  }
}

void NearestOnMesh::add(NearestPoint& nearest, const Transform& to_world,
                        const TriangleMesh::Triangle& triangle) const {
  const auto corner = [&](std::size_t k) { return to_world.point(Vec3d(mesh_.positions[triangle[k]])); };
  if (mesh_.triangles.size() > most_triangles_to_look_at) {
    for (std::size_t k = 0; k < 3; ++k) nearest.add(corner(k));
    return;
  }
  const Vec3d a = corner(0);
  nearest.add(nearest_on_triangle(nearest.to, a, corner(1) - a, corner(2) - a));
}

void NearestOnMesh::add_to(NearestPoint& nearest, const Transform& to_world) const {
  const Vec3d x = to_world.vector({1, 0, 0}), y = to_world.vector({0, 1, 0}), z = to_world.vector({0, 0, 1});
  // Along the direction to its middle no point of a box is nearer than this.
  const auto at_least = [&](const Run& run) {
    const Vec3d way = to_world.point(run.middle) - nearest.to;
    const double reach =
        std::abs(dot(way, x)) * run.half.x + std::abs(dot(way, y)) * run.half.y + std::abs(dot(way, z)) * run.half.z;
    return length(way) - reach / length(way);
  };
  const auto add_run = [&](const Run& run) {
    for (std::size_t i = run.begin; i < run.end; ++i) add(nearest, to_world, mesh_.triangles[i]);
  };
  std::vector<double> bounds;
  for (const Run& run : runs_) bounds.push_back(at_least(run));
  const auto first = std::min_element(bounds.begin(), bounds.end());  // after which few others can be nearer
  if (first != bounds.end()) add_run(runs_[static_cast<std::size_t>(first - bounds.begin())]);
  for (std::size_t i = 0; i < runs_.size(); ++i)
    if (!(bounds[i] >= nearest.distance)) add_run(runs_[i]);  // also where what is compared is not a number
}

}  // namespace photonproof::inline renderer_scene
