#include "renderer/rays/trace_tables.h"

#include <algorithm>
#include <iterator>

#include "scenes/description/overloaded.h"

namespace photonproof::inline renderer_rays {

void CurveTable::add(const Curves& curves, std::uint32_t surface) {
  owners.push_back({&curves, surface, static_cast<std::uint32_t>(segments.size())});
  const auto before = static_cast<std::uint32_t>(points.size());
  points.insert(points.end(), curves.points.begin(), curves.points.end());
  for (const std::uint32_t first : curves.segments) segments.push_back(before + first);
}

const CurveTable::Owner& CurveTable::owner_of(std::uint32_t segment) const {
  return *std::prev(std::ranges::upper_bound(owners, segment, {}, &Owner::first));
}

namespace {

ShellMesh shells_of(const Mesh& mesh, std::uint32_t surface) {
  if (mesh.shells_of == nullptr) return {};
  return {surface, static_cast<std::uint32_t>(mesh.triangle_count() / mesh.shells_of->places.size())};
}

}  // namespace

void EllipsoidTable::add(const Ellipsoids& ellipsoids, std::uint32_t surface) {
  owners.push_back({&ellipsoids, surface, count});
  count += static_cast<std::uint32_t>(ellipsoids.places.size());
}

const EllipsoidTable::Owner& EllipsoidTable::owner_of(std::uint32_t ellipsoid) const {
  return *std::prev(std::ranges::upper_bound(owners, ellipsoid, {}, &Owner::first));
}

TraceTables::TraceTables(const std::vector<Surface>& surfaces) {
  const std::vector<std::uint32_t> first_face = light_faces(surfaces);
  for (std::uint32_t i = 0; i < surfaces.size(); ++i) {
    const std::vector<LongFace>* faces = surfaces[i].long_faces.get();
    const auto add_solved = [&]<class Shape>(const Shape& shape) {
      std::uint32_t face = first_face[i];
      if constexpr (requires { shape.primitive; }) face += face == no_index ? 0 : shape.primitive;
      std::get<ShapeTable<Shape>>(solved).add(shape, i, face == no_index ? no_index : light_face | face);
    };
    if (faces != nullptr) std::for_each(faces->begin(), faces->end(), add_solved);
    std::visit(Overloaded{[&](const Quad& quad) {
                            if (faces == nullptr) quads.add(quad, i);
                          },
                          [&](const Plane& plane) { planes.add(plane, i); },
                          [&](const Curves& tubes) { curves[tubes.linear ? 1 : 0].add(tubes, i); },
                          [&](const Ellipsoids& cloud) { ellipsoids.add(cloud, i); },
                          [&](const Mesh& mesh) {
                            meshes.add(mesh, i);
                            long_faces_of_mesh.push_back(faces);
                            shells_of_mesh.push_back(shells_of(mesh, i));
                          },
                          [&](const MeshInstance& copy) { add(copy, i); }, add_solved},
               surfaces[i].geometry);
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

bool TraceTables::is_flat() const {
  if (!curves[0].segments.empty() || !curves[1].segments.empty()) return false;
  std::size_t faces = quads.shapes.size();
  for (const Mesh* mesh : meshes.shapes) faces += mesh->triangle_count();
  for (const PlacedGroup& instance : instances)
    for (const Mesh* part : groups[instance.group].parts) faces += part->triangle_count();
  const std::size_t others = std::apply([](const auto&... table) { return (table.shapes.size() + ...); }, solved);
  return faces >= 10 * (others + ellipsoids.count);
}

}  // namespace photonproof::inline renderer_rays
