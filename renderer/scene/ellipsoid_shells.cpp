#include "renderer/scene/ellipsoid_shells.h"

#include <limits>
#include <stdexcept>
#include <utility>

namespace photonproof::inline renderer_scene {

Mesh mesh_of_shells(Shell shell, const PlacedEllipsoids& placed, Ellipsoids ellipsoids) {
  const TriangleMesh one = unit_shell(shell);
  const std::size_t corners = one.positions.size();
  if (placed.count() > std::numeric_limits<std::uint32_t>::max() / one.triangles.size())
    throw std::length_error("the shells have more than 2^32 triangles");
  TriangleMesh source;
  Mesh mesh;
  source.triangles.reserve(placed.count() * one.triangles.size());
  mesh.positions.reserve(placed.count() * corners + 1);
  for (std::size_t i = 0; i < placed.count(); ++i) {
    const PlacedEllipsoid e = placed[i];
    const auto first = static_cast<std::uint32_t>(i * corners);
    for (const Vec3f& corner : one.positions)
      mesh.positions.push_back(Vec3f(
          e.center +
          (e.axes[0] * double{corner.x} + e.axes[1] * double{corner.y} + e.axes[2] * double{corner.z}) * e.reach));
    const bool mirrored = dot(e.axes[0], cross(e.axes[1], e.axes[2])) < 0;
    for (TriangleMesh::Triangle triangle : one.triangles) {
      if (mirrored) std::swap(triangle[1], triangle[2]);
      source.triangles.push_back({first + triangle[0], first + triangle[1], first + triangle[2]});
    }
  }
  mesh.positions.emplace_back();
  mesh.inward = ellipsoids.inward;
  mesh.source = std::make_shared<const TriangleMesh>(std::move(source));
  mesh.shells_of = std::make_shared<const Ellipsoids>(std::move(ellipsoids));
  return mesh;
}

}  // namespace photonproof::inline renderer_scene
