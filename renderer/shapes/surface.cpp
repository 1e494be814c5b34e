#include "renderer/shapes/surface.h"

#include <algorithm>

namespace photonproof {

AffineMap::AffineMap(const Vec3d& axis_x, const Vec3d& axis_y, const Vec3d& axis_z, const Vec3d& at)
    : x(axis_x), y(axis_y), z(axis_z), origin(at) {
  const double determinant = dot(axis_x, cross(axis_y, axis_z));
  to_x = Vec3f(cross(axis_y, axis_z) / determinant);
  to_y = Vec3f(cross(axis_z, axis_x) / determinant);
  to_z = Vec3f(cross(axis_x, axis_y) / determinant);
}

const Mesh* mesh_of(const Geometry& geometry) {
  if (const auto* copy = std::get_if<MeshInstance>(&geometry)) return copy->mesh.get();
  return std::get_if<Mesh>(&geometry);
}

const LongFace* Surface::long_face(std::size_t primitive) const {
  if (long_faces == nullptr) return nullptr;
  const auto found = std::lower_bound(long_faces->begin(), long_faces->end(), primitive,
                                      [](const LongFace& face, std::size_t p) { return face.primitive < p; });
  return found != long_faces->end() && found->primitive == primitive ? &*found : nullptr;
}

}  // namespace photonproof
