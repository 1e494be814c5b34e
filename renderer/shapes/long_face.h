// Faces too long for Embree.
#pragma once

#include <memory>
#include <vector>

#include "renderer/shapes/shape.h"

namespace photonproof::inline renderer_shapes {

/// A parallelogram or triangle so much longer than the visible scene that single precision loses the latter. It is
/// corner + u edge_u + v edge_v, in double, from the description.
struct LongFace {
  Vec3d corner, edge_u, edge_v;
  Vec3d normal;       ///< unit, on the front
  double offset = 0;  ///< normal . corner, the plane's offset, exact to the last digit of points near the origin
  bool is_triangle = false;
  std::uint32_t primitive = 0;  ///< the triangle of a mesh
};

/// The long faces of a mesh, by primitive.
using LongFaces = std::shared_ptr<const std::vector<LongFace>>;
/// Null where that primitive is not a long face, or there are none.
const LongFace* find_long_face(const LongFaces& faces, std::size_t primitive);
/// Edges are widened by this part of their length, so that nothing slips between two faces that share one. It is ten
/// times the rounding error of points on them in double precision.
inline constexpr double long_face_margin = 2e-15;
/// Distance of its edges from the origin.
double rim_distance(const LongFace& face);
/// Whether a point of its plane is within its edges, widened by this part of their length.
bool holds(const LongFace& face, const Vec3d& p, double margin);

double hit_distance(const LongFace& face, const ShapeRay& ray);
ShapePoint point_on(const LongFace& face, const Vec3d& near);
ShapeBox box_around(const LongFace& face);

}  // namespace photonproof::inline renderer_shapes
