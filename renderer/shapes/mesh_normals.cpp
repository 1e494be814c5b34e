#include "renderer/shapes/mesh_normals.h"

#include <cmath>

namespace photonproof::inline renderer_shapes {

std::vector<Vec3f> vertex_normals(const std::vector<TriangleMesh::Triangle>& triangles,
                                  const std::vector<Vec3f>& positions, std::size_t vertex_count) {
  std::vector<Vec3f> normals(vertex_count, Vec3f(0.0f));
  for (const TriangleMesh::Triangle& triangle : triangles) {
    const Vec3d corner[3] = {Vec3d(positions[triangle[0]]), Vec3d(positions[triangle[1]]),
                             Vec3d(positions[triangle[2]])};
    const Vec3d n = cross(corner[1] - corner[0], corner[2] - corner[0]);
    const double norm = length(n);
    if (!(norm > 0)) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d a = corner[(k + 1) % 3] - corner[k], b = corner[(k + 2) % 3] - corner[k];
      const double angle = std::atan2(length(cross(a, b)), dot(a, b));
      normals[triangle[k]] += Vec3f(n * (angle / norm));
    }
  }
  for (Vec3f& n : normals) {
    const float norm = length(n);
    if (norm > 0) n = n / norm;
  }
  return normals;
}

}  // namespace photonproof::inline renderer_shapes
