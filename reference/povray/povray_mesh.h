// A triangle mesh in POV-Ray: its place in the world, and its text. The text is as long as the mesh, so it is never
// held in memory.
#pragma once

#include <array>
#include <functional>
#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

#include "scenes/description/description.h"

namespace photonproof::inline reference_povray {

struct PovMesh {
  std::shared_ptr<const TriangleMesh> mesh;
  Transform to_world;
  bool flip = false;       ///< The front is where corners are clockwise.
  std::size_t number = 0;  ///< Number of its declaration, Mesh_<number>.
  bool smooth = false;     ///< Shades by normals interpolated between its vertices.
  double area = 0;         ///< Sum over all triangles, world space.
  Vec3d low, high;         ///< Corners of its bounding box, world space.

  std::array<Vec3d, 8> box_corners() const;
  /// World space, counter-clockwise seen from the front.
  std::array<Vec3d, 3> triangle(std::size_t i) const;
  /// Whether it bounds a body and its front is outside. Vertices at equal places count as one; every edge must occur as
  /// often in one direction as in the other, and the volume must be positive.
  bool is_closed() const;
  /// Whether any triangle satisfies `holds`.
  bool any_triangle(const std::function<bool(const std::array<Vec3d, 3>&)>& holds) const;
};

PovMesh place_mesh(const ShapeDescription& shape, std::shared_ptr<const TriangleMesh> mesh, bool smooth,
                   std::size_t number);

/// Vertex normals of unit length in local space. Without normals in the file, each is the mean of the adjoining
/// triangles' normals, weighted by their angles at the vertex (Thuermer and Wuethrich 1998).
std::vector<Vec3d> vertex_normals(const TriangleMesh& mesh);

/// "#declare Mesh_<number> = mesh2{...}" with lengths times `scale`. Vertices are rounded to single precision, as
/// POV-Ray stores them.
void write_mesh_declaration(const PovMesh& mesh, double scale, std::ostream& out);

}  // namespace photonproof::inline reference_povray
