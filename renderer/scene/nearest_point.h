// The nearest of several points, of the points of a triangle, and of a mesh.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "scenes/base/vec.h"
#include "scenes/description/transform.h"
#include "scenes/meshes/mesh.h"

namespace photonproof::inline renderer_scene {

/// The nearest to `to` of all points that are added; `to` must outlive this. NaNs are left out.
struct NearestPoint {
  const Vec3d& to;
  Vec3d point{0.0};
  double distance = std::numeric_limits<double>::infinity();
  void add(const Vec3d& p);
};

/// The point a + s u + t v with s, t >= 0, s + t <= 1 nearest to p; for a triangle without area, a point of it.
Vec3d nearest_on_triangle(const Vec3d& p, const Vec3d& a, const Vec3d& u, const Vec3d& v);
/// The same with s, t <= 1.
Vec3d nearest_on_parallelogram(const Vec3d& p, const Vec3d& a, const Vec3d& u, const Vec3d& v);

/// Finds the point of a mesh nearest to another without visiting most of its triangles, once for each placed copy of
/// the mesh in a scene. In a mesh with more than 4096 triangles, vertices stand for them.
class NearestOnMesh {
 public:
  /// The mesh must outlive this.
  explicit NearestOnMesh(const TriangleMesh& mesh);
  void add_to(NearestPoint& nearest, const Transform& to_world) const;

 private:
  /// Consecutive triangles, and the box around them.
  struct Run {
    std::size_t begin, end;
    Vec3d middle, half;
  };
  void add(NearestPoint& nearest, const Transform& to_world, const TriangleMesh::Triangle& triangle) const;

  const TriangleMesh& mesh_;
  std::vector<Run> runs_;
};

}  // namespace photonproof::inline renderer_scene
