#include "renderer/shapes/quad.h"

#include <array>
#include <numbers>

#include "renderer/shapes/circle_area.h"

namespace photonproof::inline renderer_shapes {
namespace {

/// Whether p is at least `radius` away from all four edges, as most points are.
bool holds_whole_disc(const Quad& quad, const Vec3f& p, float radius) {
  const Vec3f from_corner = p - quad.corner;
  const auto far_from_pair = [&](const Vec3f& edge, const Vec3f& other) {
    // Twice the areas of the triangles that p makes with the edge and with the one opposite: edge length x distance.
    const Vec3f twice_area = cross(edge, from_corner);
    const Vec3f across = cross(edge, other);
    const float needed = radius * radius * length_squared(edge);
    return length_squared(twice_area) >= needed && length_squared(across - twice_area) >= needed;
  };
  return far_from_pair(quad.edge_u, quad.edge_v) && far_from_pair(quad.edge_v, quad.edge_u);
}

}  // namespace

float disc_area(const Quad& quad, const Vec3f& p, float radius) {
  if (holds_whole_disc(quad, p, radius)) return std::numbers::pi_v<float> * radius * radius;
  const Vec3d edge_u(quad.edge_u), edge_v(quad.edge_v);
  const Vec3d x_axis = normalize(edge_u);
  const Vec3d y_axis = normalize(edge_v - x_axis * dot(edge_v, x_axis));
  const Vec3d corner = Vec3d(quad.corner) - Vec3d(p);
  const std::array<Vec3d, 4> corners{corner, corner + edge_u, corner + edge_u + edge_v, corner + edge_v};
  std::array<PlanePoint, 4> polygon;
  for (std::size_t i = 0; i < 4; ++i) polygon[i] = {dot(corners[i], x_axis), dot(corners[i], y_axis)};
  return static_cast<float>(polygon_in_circle(polygon, radius));
}

ShapeBox box_around(const Quad& quad) {
  ShapeBox box;
  for (const Vec3f& p :
       {quad.corner, quad.corner + quad.edge_u, quad.corner + quad.edge_v, quad.corner + quad.edge_u + quad.edge_v})
    box.add(p);
  return box;
}

LocalGeometry local_geometry(const Quad&, const AffineMap& frame, const Vec3f& p, const Vec3f& normal) {
  return local_geometry_of_square(frame, p, normal);
}

}  // namespace photonproof::inline renderer_shapes
