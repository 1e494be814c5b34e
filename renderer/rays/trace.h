// Ray queries through Embree. Only this room includes Embree (3.13 and 4.x both build).
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "renderer/core/ray.h"
#include "renderer/rays/cloud_entries.h"
#include "renderer/shapes/surface.h"

namespace photonproof::inline renderer_rays {

/// Rays of a pack of at most `width` lanes.
struct alignas(64) RayBlock {
  static constexpr std::size_t width = 16;
  float origin_x[width], origin_y[width], origin_z[width];
  float direction_x[width], direction_y[width], direction_z[width];
  std::uint32_t light[width];  ///< the face that the ray leaves or ends on (ray.h), or anything without these bits
  std::uint32_t active;        ///< bit i: lane i has a ray
};

/// Ends of the rays; `surface` is no_index on a miss, and then the rest is undefined. Points are exact to rounding:
/// they come from the primitive's vertices, not from the ray. Normals are unit.
struct alignas(64) HitBlock {
  float p_x[RayBlock::width], p_y[RayBlock::width], p_z[RayBlock::width];
  float normal_x[RayBlock::width], normal_y[RayBlock::width], normal_z[RayBlock::width];
  std::uint32_t surface[RayBlock::width];
  std::uint32_t primitive[RayBlock::width];  ///< the triangle of a mesh, the segment of curves, else 0
};

/// Immutable once built; safe for any number of threads. Quads, triangles and curves are Embree's (ROBUST); other
/// shapes and long faces are user geometry, solved in double precision. Planes are tested separately.
class Tracer {
 public:
  /// Throws std::runtime_error with Embree's message when it cannot build. `surfaces` must outlive the tracer.
  explicit Tracer(const std::vector<Surface>& surfaces);
  ~Tracer();
  Tracer(const Tracer&) = delete;
  Tracer& operator=(const Tracer&) = delete;

  /// Closest surfaces, t >= 0. A ray with a non-finite component hits nothing. `coherent`: the rays are neighbours from
  /// one point. Rays traverse the BVH as packets and end where they would alone; among curves only coherent ones do.
  void intersect(const RayBlock& rays, HitBlock& hits, bool coherent) const;
  /// blocked[i] = 1 where a surface lies on the segment from the origin to origin + direction, else 0.
  void occluded(const RayBlock& rays, std::uint32_t* blocked) const;

  /// Takes the next ellipsoids that a ray with a unit direction enters, up to the first other surface.
  void take_entries(const Vec3f& origin, const Vec3f& direction, CloudEntries& entries) const;

  /// Bytes that Embree holds, as it reports them.
  std::size_t bvh_bytes() const;

  /// How Embree's own queries trace the rays of a block.
  enum class Alone { one_by_one, as_packets, as_neighbours };
  /// Calls only Embree's queries for the active lanes: the baseline of the benches. Returns the number of rays that hit
  /// something.
  std::size_t count_hits_alone(const std::vector<RayBlock>& rays, Alone how) const;
  std::size_t count_occluded_alone(const std::vector<RayBlock>& rays, Alone how) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace photonproof::inline renderer_rays
