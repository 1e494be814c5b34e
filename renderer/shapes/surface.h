// The surfaces rays meet: parallelograms (rectangles, faces of cubes), spheres, discs, cylinders and planes, each as
// itself, and meshes, which may also be copies placed by a transform.
#pragma once

#include <cstdint>
#include <memory>
#include <variant>
#include <vector>

#include "renderer/core/ray.h"
#include "scenes/description/transform.h"
#include "scenes/meshes/mesh.h"
#include "scenes/meshes/vec.h"

namespace photonproof {

/// corner + u edge_u + v edge_v for u, v in [0,1]; `normal` = edge_u x edge_v, normalised, flipped where the file says.
struct Quad {
  Vec3f corner, edge_u, edge_v;
  Vec3f normal;
  float area;
};

struct Sphere {
  Vec3f center;
  float radius;
  bool inward;  ///< the normal points to the centre
  Vec3f normal_at(const Vec3f& p) const {
    const Vec3f n = (p - center) / radius;
    return inward ? -n : n;
  }
  float area() const { return 4 * 3.14159265358979f * radius * radius; }
};

/// center + x axis_x + y axis_y for x^2 + y^2 <= 1: an ellipse where the axes are not alike. `normal` as of a Quad.
struct Disk {
  Vec3f center, axis_x, axis_y;
  Vec3f normal;
  float area;
};

/// The points at distance `radius` from the segment base + [0, length] axis; no caps.
struct Cylinder {
  Vec3f base, axis;  ///< axis is unit
  float length, radius;
  bool inward;  ///< the normal points to the axis
  float area() const { return 2 * 3.14159265358979f * radius * length; }
};

/// Every x with normal . (x - point) = 0.
struct Plane {
  Vec3d point, normal;  ///< unit
};

struct Mesh {
  std::vector<Vec3f> positions;  ///< world space, with one spare at the end, which Embree's 16-byte reads touch
  std::shared_ptr<const TriangleMesh> source;
  bool inward = false;         ///< the normal is opposite to the winding's
  std::vector<Vec3f> normals;  ///< a vertex, unit, on the side of the winding's; empty where the mesh is flat
  bool flip_v = false;         ///< the source's v counts from the other end

  std::size_t triangle_count() const { return source->triangles.size(); }
  Vec3f corner(std::size_t triangle, std::size_t k) const { return positions[source->triangles[triangle][k]]; }
};

/// An affine map with its inverse, in single precision.
struct AffineMap {
  Vec3f x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, origin;   ///< images of the local axes and of the local origin
  Vec3f to_x{1, 0, 0}, to_y{0, 1, 0}, to_z{0, 0, 1};  ///< rows of the inverse's linear part

  AffineMap() = default;
  /// The axes are not in one plane.
  AffineMap(const Vec3d& axis_x, const Vec3d& axis_y, const Vec3d& axis_z, const Vec3d& at);
  explicit AffineMap(const Transform& m)
      : AffineMap(m.vector({1, 0, 0}), m.vector({0, 1, 0}), m.vector({0, 0, 1}), m.point({0, 0, 0})) {}
  Vec3f point(const Vec3f& p) const { return origin + vector(p); }
  Vec3f vector(const Vec3f& v) const { return x * v.x + y * v.y + z * v.z; }
  Vec3f local_point(const Vec3f& p) const { return local_vector(p - origin); }
  Vec3f local_vector(const Vec3f& v) const { return {dot(to_x, v), dot(to_y, v), dot(to_z, v)}; }
  /// Of a local normal: by the inverse's transpose, not normalised.
  Vec3f normal(const Vec3f& n) const { return to_x * n.x + to_y * n.y + to_z * n.z; }
};

/// A mesh that several instances share. Its normals and winding are those of its local space.
struct MeshInstance {
  std::shared_ptr<const Mesh> mesh;
  std::shared_ptr<const AffineMap> placement;  ///< of all meshes of the instance
  std::uint32_t instance = 0;                  ///< number of the instance in the scene
  std::uint32_t group = 0, part = 0;           ///< the group, and which of its meshes
};

/// A parallelogram or triangle that is so much longer than what is looked at that single precision loses the latter:
/// corner + u edge_u + v edge_v as the description has it, in double.
struct LongFace {
  Vec3d corner, edge_u, edge_v;
  Vec3d normal;       ///< unit, in front
  double offset = 0;  ///< normal . corner: of x on the face, normal . x, to the last digit of what is near the origin
  bool is_triangle = false;
  std::uint32_t primitive = 0;  ///< the triangle of a mesh
};

using Geometry = std::variant<Quad, Sphere, Mesh, Disk, Cylinder, Plane, MeshInstance>;

/// The mesh that it is or is a copy of; null for other shapes.
const Mesh* mesh_of(const Geometry& geometry);

struct Surface {
  Geometry geometry;
  std::uint32_t bsdf = 0;
  std::uint32_t light = no_index;                                ///< index into Scene::lights where it emits
  std::uint32_t interior = no_index, exterior = no_index;        ///< media, by the description's indices
  std::uint32_t uv_frame = no_index;                             ///< index into the detail's frames; a mesh has none
  std::shared_ptr<const std::vector<LongFace>> long_faces = {};  ///< by primitive; null where there are none

  /// Null where that primitive is none.
  const LongFace* long_face(std::size_t primitive) const;
};

}  // namespace photonproof
