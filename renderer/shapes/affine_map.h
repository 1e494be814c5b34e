// Affine maps in single precision: frames of texture coordinates, placements of instances.
#pragma once

#include "scenes/base/vec.h"
#include "scenes/description/transform.h"

namespace photonproof::inline renderer_shapes {

/// An affine map with its inverse, in single precision.
struct AffineMap {
  Vec3f x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, origin;   ///< images of the local axes and of the local origin
  Vec3f to_x{1, 0, 0}, to_y{0, 1, 0}, to_z{0, 0, 1};  ///< rows of the inverse's linear part

  AffineMap() = default;
  /// The axes must not lie in one plane.
  AffineMap(const Vec3d& axis_x, const Vec3d& axis_y, const Vec3d& axis_z, const Vec3d& at);
  explicit AffineMap(const Transform& m)
      : AffineMap(m.vector({1, 0, 0}), m.vector({0, 1, 0}), m.vector({0, 0, 1}), m.point({0, 0, 0})) {}
  Vec3f point(const Vec3f& p) const { return origin + vector(p); }
  Vec3f vector(const Vec3f& v) const { return x * v.x + y * v.y + z * v.z; }
  Vec3f local_point(const Vec3f& p) const { return local_vector(p - origin); }
  Vec3f local_vector(const Vec3f& v) const { return {dot(to_x, v), dot(to_y, v), dot(to_z, v)}; }
  /// Image of a local normal: by the inverse's transpose, not normalised.
  Vec3f normal(const Vec3f& n) const { return to_x * n.x + to_y * n.y + to_z * n.z; }
};

}  // namespace photonproof::inline renderer_shapes
