// Parallelograms: rectangles and the faces of cubes. Embree intersects rays with them.
#pragma once

#include "renderer/shapes/shape.h"

namespace photonproof::inline renderer_shapes {

/// corner + u edge_u + v edge_v for u, v in [0,1]; `normal` = edge_u x edge_v, normalised, flipped by flip_normals.
struct Quad {
  Vec3f corner, edge_u, edge_v;
  Vec3f normal;
  float area;

  static constexpr bool is_round = false;
  float curvature_radius() const { return flat_curvature; }
  bool sees_itself(bool) const { return false; }
};

ShapeBox box_around(const Quad& quad);
LocalGeometry local_geometry(const Quad& quad, const AffineMap& frame, const Vec3f& p, const Vec3f& normal);
/// Exact: the disc in the quad's plane intersected with the parallelogram.
float disc_area(const Quad& quad, const Vec3f& p, float radius);

}  // namespace photonproof::inline renderer_shapes
