#include "renderer/scene/projection_targets.h"

#include <algorithm>
#include <cmath>

namespace photonproof::inline renderer_scene {
namespace {

ProjectionTarget ball_around(const Sphere& sphere) { return {Vec3f(sphere.center), static_cast<float>(sphere.radius)}; }

ProjectionTarget ball_around(const Quad& quad) {
  const Vec3f half_diagonal = (quad.edge_u + quad.edge_v) * 0.5f;
  const float reach = std::max(length(half_diagonal), length((quad.edge_u - quad.edge_v) * 0.5f));
  return {quad.corner + half_diagonal, reach};
}

/// Ball around the box of a shape for which there is no smaller ball.
template <class Shape>
ProjectionTarget ball_around(const Shape& shape) {
  return ball_around_box(box_around(shape));
}

ProjectionTarget ball_around(const Disk& disk) {
  return {disk.center, std::hypot(length(disk.axis_x), length(disk.axis_y))};
}

ProjectionTarget ball_around(const Cylinder& cylinder) {
  return {Vec3f(cylinder.base + cylinder.axis * (0.5 * cylinder.length)),
          static_cast<float>(std::hypot(0.5 * cylinder.length, cylinder.radius))};
}

/// Practically everywhere; its cone is the whole sphere.
ProjectionTarget ball_around(const Plane& plane) { return {Vec3f(plane.point), 1e18f}; }

/// The placement's largest stretch is at most the root of the sum of its axes' squares.
ProjectionTarget ball_around(const MeshInstance& copy) {
  const ProjectionTarget local = ball_around(*copy.mesh);
  const AffineMap& map = *copy.placement;
  return {map.point(local.center), local.radius * std::sqrt(dot(map.x, map.x) + dot(map.y, map.y) + dot(map.z, map.z))};
}

}  // namespace

ProjectionTarget ball_around_box(const ShapeBox& box) {
  if (!(box.low.x <= box.high.x)) return {Vec3f(0.0f), 0};
  return {(box.low + box.high) * 0.5f, length(box.high - box.low) * 0.5f};
}

std::vector<ProjectionTarget> projection_targets(const std::vector<Surface>& surfaces,
                                                 const std::function<bool(const Surface&)>& is_specular) {
  constexpr float margin = 1 + 1e-4f;  // what rounding could leave outside
  std::vector<ProjectionTarget> targets;
  for (const Surface& surface : surfaces) {
    if (!is_specular(surface)) continue;
    ProjectionTarget target = std::visit([](const auto& g) { return ball_around(g); }, surface.geometry);
    target.radius *= margin;
    targets.push_back(target);
  }
  return targets;
}

}  // namespace photonproof::inline renderer_scene
