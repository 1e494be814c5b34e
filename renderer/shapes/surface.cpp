#include "renderer/shapes/surface.h"

#include <algorithm>
#include <stdexcept>

namespace photonproof::inline renderer_shapes {

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

const Ellipsoids* ellipsoids_of(const Geometry& geometry) {
  if (const auto* mesh = std::get_if<Mesh>(&geometry)) return mesh->shells_of.get();
  return std::get_if<Ellipsoids>(&geometry);
}

std::vector<std::uint32_t> light_faces(const std::vector<Surface>& surfaces) {
  std::vector<std::uint32_t> first(surfaces.size(), no_index);
  std::size_t faces = 0;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    if (surfaces[i].light == no_index) continue;
    first[i] = static_cast<std::uint32_t>(faces);
    const Mesh* mesh = mesh_of(surfaces[i].geometry);
    faces += mesh != nullptr ? mesh->triangle_count() : 1;
  }
  if (faces >= light_at_end) throw std::length_error("the lights have more than 2^30 faces");
  return first;
}

}  // namespace photonproof::inline renderer_shapes
