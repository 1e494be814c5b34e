#include "renderer/shapes/shape.h"

#include <algorithm>
#include <cmath>

namespace photonproof {

void ShapeBox::add(const Vec3f& p) { add({p, p}); }

void ShapeBox::add(const ShapeBox& other) {
  low = {std::min(low.x, other.low.x), std::min(low.y, other.low.y), std::min(low.z, other.low.z)};
  high = {std::max(high.x, other.high.x), std::max(high.y, other.high.y), std::max(high.z, other.high.z)};
}

double plane_distance(const Vec3d& point, const Vec3d& normal, const ShapeRay& ray) {
  const double t = dot(normal, point - ray.origin) / dot(normal, ray.direction);
  return t > 0 && t >= ray.t_near && t <= ray.t_far ? t : missed;  // a NaN, of a parallel ray, is a miss
}

ShapeBox padded_box(const Vec3d& low, const Vec3d& high) {
  const double reach = std::max(
      {std::abs(low.x), std::abs(low.y), std::abs(low.z), std::abs(high.x), std::abs(high.y), std::abs(high.z)});
  const Vec3d margin(reach * 0x1p-20);
  return {Vec3f(low - margin), Vec3f(high + margin)};
}

double largest_coordinate(const Vec3f& p) {
  return std::max({std::abs(double{p.x}), std::abs(double{p.y}), std::abs(double{p.z})});
}

LocalGeometry local_geometry_of_square(const AffineMap& frame, const Vec3f& p, const Vec3f& normal) {
  const Vec3f local = frame.local_point(p);
  return {{local.x, local.y}, frame.x, frame.y, normal};
}

}  // namespace photonproof
