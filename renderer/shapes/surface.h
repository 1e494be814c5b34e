// The surfaces that rays meet. Parallelograms (rectangles, faces of cubes), spheres, discs, cylinders, planes, curves,
// ellipsoids and zeros of signed distances are themselves. Meshes may also be copies placed by a transform.
#pragma once

#include <cstdint>
#include <memory>
#include <variant>
#include <vector>

#include "renderer/core/ray.h"
#include "renderer/shapes/curves.h"
#include "renderer/shapes/cylinder.h"
#include "renderer/shapes/disk.h"
#include "renderer/shapes/ellipsoids.h"
#include "renderer/shapes/long_face.h"
#include "renderer/shapes/plane.h"
#include "renderer/shapes/quad.h"
#include "renderer/shapes/sdf_grid.h"
#include "renderer/shapes/sphere.h"
#include "scenes/meshes/mesh.h"

namespace photonproof::inline renderer_shapes {

struct Mesh {
  std::vector<Vec3f> positions;  ///< world space, with one spare at the end, which Embree's 16-byte reads touch
  std::shared_ptr<const TriangleMesh> source;
  bool inward = false;         ///< The normal is opposite to the winding's.
  std::vector<Vec3f> normals;  ///< One per vertex, unit, on the side of the winding's; empty where the mesh is flat.
  bool flip_v = false;         ///< The source's v counts from the other end.
  /// Ellipsoids whose shells the triangles are, in turn and as many each; rays pass them from behind. Often null.
  std::shared_ptr<const Ellipsoids> shells_of = {};

  std::size_t triangle_count() const { return source->triangles.size(); }
  Vec3f corner(std::size_t triangle, std::size_t k) const { return positions[source->triangles[triangle][k]]; }
  static constexpr bool is_round = false;
  float curvature_radius() const { return 0; }
  bool sees_itself(bool) const { return true; }
};
ShapeBox box_around(const Mesh& mesh);

/// A mesh that several instances share. Its normals and winding are those of its local space.
struct MeshInstance {
  std::shared_ptr<const Mesh> mesh;
  std::shared_ptr<const AffineMap> placement;  ///< common to all meshes of the instance
  std::uint32_t instance = 0;                  ///< number of the instance in the scene
  std::uint32_t group = 0, part = 0;           ///< the group, and the index of the mesh in it
  static constexpr bool is_round = false;
  float curvature_radius() const { return 0; }
  bool sees_itself(bool) const { return true; }
};
ShapeBox box_around(const MeshInstance& copy);

/// The finite shapes that Embree does not have, and others: one row per shape.
template <template <class...> class List, class... Other>
using SolvedShapes = List<Sphere, Disk, Cylinder, SdfGrid, Other...>;

using Geometry = SolvedShapes<std::variant, Quad, Mesh, Plane, MeshInstance, Curves, Ellipsoids>;

/// The mesh of a mesh or of a copy of one; null for other shapes.
const Mesh* mesh_of(const Geometry& geometry);

/// The ellipsoids of a surface, or those within its shells; null for other surfaces.
const Ellipsoids* ellipsoids_of(const Geometry& geometry);

struct Surface {
  Geometry geometry;
  std::uint32_t bsdf = 0;
  std::uint32_t light = no_index;                          ///< index into Scene::lights where it emits
  std::uint32_t interior = no_index, exterior = no_index;  ///< media, by the description's indices
  std::uint32_t uv_frame = no_index;                       ///< index into the detail's frames; a mesh has none
  LongFaces long_faces = {};                               ///< null where there are none

  /// Null where that primitive is not a long face.
  const LongFace* long_face(std::size_t primitive) const { return find_long_face(long_faces, primitive); }
};

/// Number of each surface's first face among those of all lights; no_index where it does not emit. Faces are the
/// triangles of meshes and other shapes as a whole.
std::vector<std::uint32_t> light_faces(const std::vector<Surface>& surfaces);

}  // namespace photonproof::inline renderer_shapes
