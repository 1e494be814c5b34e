// Where rays of a block meet meshes. The corners of all lanes' triangles are loaded first, so that memory latencies
// overlap; then all lanes are computed together.
#pragma once

#include <cmath>

#include "renderer/rays/for_each_lane.h"
#include "renderer/rays/trace.h"
#include "renderer/shapes/face_normal.h"
#include "renderer/shapes/surface.h"

namespace photonproof::inline renderer_rays {

/// The point of a triangle at barycentric coordinates u and v, and its unit normal on the front side.
struct OnTriangle {
  Vec3f p, normal;
};
inline OnTriangle on_triangle(const Mesh& mesh, std::uint32_t primitive, float u, float v) {
  const Vec3f corner = mesh.corner(primitive, 0);
  const Vec3f edge_u = mesh.corner(primitive, 1) - corner;
  const Vec3f edge_v = mesh.corner(primitive, 2) - corner;
  const Vec3f normal = face_normal(edge_u, edge_v);
  return {corner + edge_u * u + edge_v * v, mesh.inward ? -normal : normal};
}

/// Triangles that the lanes of a block met.
class MeshHits {
 public:
  /// Adds a lane's triangle; a lane is added once.
  void add(std::size_t lane, const Mesh& mesh, std::uint32_t primitive) {
    lanes_ |= 1u << lane;
    mesh_[lane] = &mesh;
    primitive_[lane] = primitive;
    __builtin_prefetch(&mesh.source->triangles[primitive]);
  }

  /// Writes the points and normals of the added lanes; others are undefined. The bits are those of on_triangle.
  void locate(const float* u, const float* v, HitBlock& hits) const {
    if (lanes_ == 0) return;
    constexpr std::size_t width = RayBlock::width;
    alignas(64) float corner[3][3][width] = {};  // of each lane's triangle: corner, axis
    alignas(64) float side[width] = {};
    for_each_lane(lanes_, [&](std::size_t i) {
      const Mesh& mesh = *mesh_[i];
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3f p = mesh.corner(primitive_[i], k);
        corner[k][0][i] = p.x, corner[k][1][i] = p.y, corner[k][2][i] = p.z;
      }
      side[i] = mesh.inward ? -1.0f : 1.0f;
    });
    alignas(64) float square[width], length[width];
    const auto at = [&](std::size_t k, std::size_t i) {
      return Vec3f(corner[k][0][i], corner[k][1][i], corner[k][2][i]);
    };
    for (std::size_t i = 0; i < width; ++i) {
      const Vec3f edge_u = at(1, i) - at(0, i), edge_v = at(2, i) - at(0, i);
      const Vec3f p = at(0, i) + edge_u * u[i] + edge_v * v[i], n = cross(edge_u, edge_v);
      hits.p_x[i] = p.x, hits.p_y[i] = p.y, hits.p_z[i] = p.z;
      hits.normal_x[i] = n.x, hits.normal_y[i] = n.y, hits.normal_z[i] = n.z;
      square[i] = dot(n, n);
    }
    for (std::size_t i = 0; i < width; ++i) length[i] = std::sqrt(square[i]);
    for (std::size_t i = 0; i < width; ++i) {
      hits.normal_x[i] = hits.normal_x[i] / length[i] * side[i];
      hits.normal_y[i] = hits.normal_y[i] / length[i] * side[i];
      hits.normal_z[i] = hits.normal_z[i] / length[i] * side[i];
    }
    for_each_lane(lanes_, [&](std::size_t i) {
      if (fits_single(square[i])) [[likely]]
        return;
      const Vec3f normal = on_triangle(*mesh_[i], primitive_[i], u[i], v[i]).normal;
      hits.normal_x[i] = normal.x, hits.normal_y[i] = normal.y, hits.normal_z[i] = normal.z;
    });
  }

 private:
  std::uint32_t lanes_ = 0;
  const Mesh* mesh_[RayBlock::width];
  std::uint32_t primitive_[RayBlock::width];
};

}  // namespace photonproof::inline renderer_rays
