// The nearest of points, and of the points of a triangle.
#pragma once

#include <limits>

#include "scenes/meshes/vec.h"

namespace photonproof {

/// Of all points that are added the one nearest to `to`, which has to outlive this; NaNs are left out.
struct NearestPoint {
  const Vec3d& to;
  Vec3d point{0.0};
  double distance = std::numeric_limits<double>::infinity();
  void add(const Vec3d& p);
};

/// The point a + s u + t v, s, t >= 0, s + t <= 1 nearest to p; of a triangle without area, a point of it.
Vec3d nearest_on_triangle(const Vec3d& p, const Vec3d& a, const Vec3d& u, const Vec3d& v);
/// The same of s, t <= 1.
Vec3d nearest_on_parallelogram(const Vec3d& p, const Vec3d& a, const Vec3d& u, const Vec3d& v);

}  // namespace photonproof
