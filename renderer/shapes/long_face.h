// Faces too long for Embree.
#pragma once

#include <memory>
#include <vector>

#include "renderer/shapes/shape.h"

namespace photonproof::inline renderer_shapes {

/// A parallelogram or triangle that is so much longer than what is looked at that single precision loses the latter:
/// corner + u edge_u + v edge_v as the description has it, in double.
struct LongFace {
  Vec3d corner, edge_u, edge_v;
  Vec3d normal;       ///< unit, in front
  double offset = 0;  ///< normal . corner: of x on the face, normal . x, to the last digit of what is near the origin
  bool is_triangle = false;
  std::uint32_t primitive = 0;  ///< the triangle of a mesh
};

/// Of a mesh, by primitive.
using LongFaces = std::shared_ptr<const std::vector<LongFace>>;
/// Null where that primitive is none, or there are none.
const LongFace* find_long_face(const LongFaces& faces, std::size_t primitive);
/// Edges are widened by this part of their length, so that nothing slips between two faces that share one: ten times
/// what rounding in double precision makes of points in them.
inline constexpr double long_face_margin = 2e-15;
/// Of its edges from the origin.
double rim_distance(const LongFace& face);
/// Whether a point of its plane is within its edges, up to this part of their length.
bool holds(const LongFace& face, const Vec3d& p, double margin);

double hit_distance(const LongFace& face, const ShapeRay& ray);
ShapePoint point_on(const LongFace& face, const Vec3d& near);
ShapeBox box_around(const LongFace& face);

}  // namespace photonproof::inline renderer_shapes
