#include "renderer/shapes/affine_map.h"

namespace photonproof::inline renderer_shapes {

AffineMap::AffineMap(const Vec3d& axis_x, const Vec3d& axis_y, const Vec3d& axis_z, const Vec3d& at)
    : x(axis_x), y(axis_y), z(axis_z), origin(at) {
  const double determinant = dot(axis_x, cross(axis_y, axis_z));
  to_x = Vec3f(cross(axis_y, axis_z) / determinant);
  to_y = Vec3f(cross(axis_z, axis_x) / determinant);
  to_z = Vec3f(cross(axis_x, axis_y) / determinant);
}

}  // namespace photonproof::inline renderer_shapes
