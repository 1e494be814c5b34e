// Ray queries. Only trace.cpp includes Embree (3.13 and 4.x both build).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "renderer/ray.h"
#include "renderer/surface.h"

namespace photonproof {

/// Immutable once built; safe for any number of threads. Quads are Embree quads (ROBUST), spheres user geometry solved
/// in double precision.
class Tracer {
 public:
  /// Throws std::runtime_error with Embree's message when it cannot build. `surfaces` must outlive the tracer.
  explicit Tracer(const std::vector<Surface>& surfaces);
  ~Tracer();
  Tracer(const Tracer&) = delete;
  Tracer& operator=(const Tracer&) = delete;

  /// Closest surface in [t_near, t_far]. A ray with a non-finite component hits nothing.
  Hit intersect(const Ray& ray) const;
  /// Whether anything lies in [t_near, t_far].
  bool occluded(const Ray& ray) const;

  /// The point moved off its surface to the side `towards` points to, by 4 ulp of its coordinates: far enough that the
  /// next ray cannot meet the same surface by rounding, close enough to leak through nothing (Embree is ROBUST).
  Vec3f offset(const Vec3f& p_world, const Vec3f& normal, const Vec3f& towards) const;

  static std::string embree_version();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace photonproof
