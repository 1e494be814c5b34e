// The surfaces rays meet: parallelograms (rectangles, faces of cubes) and spheres, each as itself, and meshes.
#pragma once

#include <cstdint>
#include <memory>
#include <variant>
#include <vector>

#include "renderer/ray.h"
#include "scenes/mesh.h"
#include "scenes/vec.h"

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

struct Mesh {
  std::vector<Vec3f> positions;  ///< world space, with one spare at the end, which Embree's 16-byte reads touch
  std::shared_ptr<const TriangleMesh> source;
  bool inward = false;  ///< the normal is opposite to the winding's

  std::size_t triangle_count() const { return source->triangles.size(); }
  Vec3f corner(std::size_t triangle, std::size_t k) const { return positions[source->triangles[triangle][k]]; }
};

using Geometry = std::variant<Quad, Sphere, Mesh>;

struct Surface {
  Geometry geometry;
  std::uint32_t bsdf = 0;
  std::uint32_t light = no_index;                            ///< index into Scene::lights where it emits
  std::uint32_t interior = no_index, exterior = no_index;  ///< media, by the description's indices
};

}  // namespace photonproof
