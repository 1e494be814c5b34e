#include "renderer/shapes/shape_place.h"

#include <cmath>

namespace photonproof::inline renderer_shapes {

void ShapePlace::refuse(const std::string& why) const { throw InputError(scene.where(shape.loc), why); }

void ShapePlace::require_similarity() const {
  const Vec3d x = to_world.vector({1, 0, 0}), y = to_world.vector({0, 1, 0}), z = to_world.vector({0, 0, 1});
  const double scale = dot(x, x);
  const auto differs = [&](double a, double b) { return std::abs(a - b) > 1e-4 * scale; };
  if (differs(dot(y, y), scale) || differs(dot(z, z), scale) || differs(dot(x, y), 0) || differs(dot(x, z), 0) ||
      differs(dot(y, z), 0))
    refuse("this shape cannot be stretched or sheared, by an instance either");
}

Vec3d ShapePlace::flat_normal(const Vec3d& edge_u, const Vec3d& edge_v) const {
  const bool turned = shape.flip_normals != (to_world.determinant() < 0);
  return normalize(cross(edge_u, edge_v)) * (turned ? -1.0 : 1.0);
}

AffineMap flat_frame(const Vec3d& origin, const Vec3d& along_u, const Vec3d& along_v) {
  return {along_u, along_v, normalize(cross(along_u, along_v)), origin};
}

}  // namespace photonproof::inline renderer_shapes
