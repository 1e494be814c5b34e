#include "renderer/shapes/scene_ball.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "renderer/shapes/curved_shapes.h"

namespace photonproof {
namespace {

struct Box {
  Vec3f low{std::numeric_limits<float>::infinity()}, high{-std::numeric_limits<float>::infinity()};
  void add(const Vec3f& p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
};

void add_to(Box& box, const Quad& quad) {
  for (const Vec3f& p :
       {quad.corner, quad.corner + quad.edge_u, quad.corner + quad.edge_v, quad.corner + quad.edge_u + quad.edge_v})
    box.add(p);
}

void add_to(Box& box, const Sphere& sphere) {
  box.add(sphere.center - Vec3f(sphere.radius));
  box.add(sphere.center + Vec3f(sphere.radius));
}

void add_to(Box& box, const Mesh& mesh) {
  for (std::size_t i = 0; i + 1 < mesh.positions.size(); ++i) box.add(mesh.positions[i]);  // the last is a spare
}

template <class Shape>
void add_bounds(Box& box, const Shape& shape) {
  const ShapeBox bounds = box_around(shape);
  box.add(bounds.low);
  box.add(bounds.high);
}
void add_to(Box& box, const Disk& disk) { add_bounds(box, disk); }
void add_to(Box& box, const Cylinder& cylinder) { add_bounds(box, cylinder); }
void add_to(Box&, const Plane&) {}

void add_to(Box& box, const MeshInstance& copy) {
  const Mesh& mesh = *copy.mesh;
  for (std::size_t i = 0; i + 1 < mesh.positions.size(); ++i) box.add(copy.placement->point(mesh.positions[i]));
}

}  // namespace

SceneBall scene_ball(const std::vector<Surface>& surfaces) {
  Box box;
  for (const Surface& surface : surfaces) std::visit([&](const auto& g) { add_to(box, g); }, surface.geometry);
  constexpr float margin = 1 + 1e-4f;  // what rounding could leave outside
  const float radius = length(box.high - box.low) * 0.5f * margin;
  if (!(radius > 0) || !std::isfinite(radius)) return {};
  return {(box.low + box.high) * 0.5f, radius};
}

}  // namespace photonproof
