#include "renderer/rays/trace_tables.h"

namespace photonproof {

TraceTables::TraceTables(const std::vector<Surface>& surfaces) {
  for (std::uint32_t i = 0; i < surfaces.size(); ++i) {
    const Geometry& geometry = surfaces[i].geometry;
    const std::vector<LongFace>* faces = surfaces[i].long_faces.get();
    if (faces != nullptr)
      for (const LongFace& face : *faces) long_faces.add(face, i);
    if (const auto* quad = std::get_if<Quad>(&geometry); quad != nullptr && faces == nullptr) quads.add(*quad, i);
    if (const auto* sphere = std::get_if<Sphere>(&geometry)) spheres.add(*sphere, i);
    if (const auto* disk = std::get_if<Disk>(&geometry)) disks.add(*disk, i);
    if (const auto* cylinder = std::get_if<Cylinder>(&geometry)) cylinders.add(*cylinder, i);
    if (const auto* plane = std::get_if<Plane>(&geometry)) planes.add(*plane, i);
    if (const auto* mesh = std::get_if<Mesh>(&geometry)) {
      meshes.add(*mesh, i);
      long_faces_of_mesh.push_back(faces);
    }
    if (const auto* copy = std::get_if<MeshInstance>(&geometry)) add(*copy, i);
  }
}

void TraceTables::add(const MeshInstance& copy, std::uint32_t surface) {
  if (copy.group >= groups.size()) groups.resize(copy.group + 1);
  std::vector<const Mesh*>& parts = groups[copy.group].parts;
  if (copy.part >= parts.size()) parts.resize(copy.part + 1);
  parts[copy.part] = copy.mesh.get();
  if (copy.instance >= instances.size()) instances.resize(copy.instance + 1);
  PlacedGroup& instance = instances[copy.instance];
  instance.group = copy.group;
  instance.placement = copy.placement.get();
  if (copy.part >= instance.surface.size()) instance.surface.resize(copy.part + 1, no_index);
  instance.surface[copy.part] = surface;
}

}  // namespace photonproof
