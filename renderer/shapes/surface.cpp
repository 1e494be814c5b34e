#include "renderer/shapes/surface.h"

#include <algorithm>

namespace photonproof {

ShapeBox box_around(const Mesh& mesh) {
  ShapeBox box;
  for (std::size_t i = 0; i + 1 < mesh.positions.size(); ++i) box.add(mesh.positions[i]);  // the last is a spare
  return box;
}

ShapeBox box_around(const MeshInstance& copy) {
  const Mesh& mesh = *copy.mesh;
  ShapeBox box;
  for (std::size_t i = 0; i + 1 < mesh.positions.size(); ++i) box.add(copy.placement->point(mesh.positions[i]));
  return box;
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
