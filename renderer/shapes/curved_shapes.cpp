#include "renderer/shapes/curved_shapes.h"

#include <algorithm>
#include <cmath>

namespace photonproof {
namespace {

constexpr double missed = -1;

double largest_coordinate(const Vec3f& p) {
  return std::max({std::abs(double{p.x}), std::abs(double{p.y}), std::abs(double{p.z})});
}

/// The parameter where the ray crosses the plane through `point`, if ahead.
double plane_distance(const Vec3d& point, const Vec3d& normal, const ShapeRay& ray) {
  const double t = dot(normal, point - ray.origin) / dot(normal, ray.direction);
  return t > 0 && t >= ray.t_near && t <= ray.t_far ? t : missed;  // a NaN, of a parallel ray, is a miss
}

/// Coordinates of q in the basis of two vectors that span its plane, which need not be perpendicular.
Vec2<double> in_basis(const Vec3d& q, const Vec3d& a, const Vec3d& b) {
  const double aa = dot(a, a), ab = dot(a, b), bb = dot(b, b), qa = dot(q, a), qb = dot(q, b);
  const double det = aa * bb - ab * ab;
  return {(qa * bb - qb * ab) / det, (qb * aa - qa * ab) / det};
}

ShapeBox padded(const Vec3d& low, const Vec3d& high) {
  const double reach = std::max(
      {std::abs(low.x), std::abs(low.y), std::abs(low.z), std::abs(high.x), std::abs(high.y), std::abs(high.z)});
  const Vec3d margin(reach * 0x1p-20);
  return {Vec3f(low - margin), Vec3f(high + margin)};
}

}  // namespace

double hit_distance(const Sphere& sphere, const ShapeRay& ray) {
  const Vec3d& d = ray.direction;
  const Vec3d to_center = Vec3d(sphere.center) - ray.origin;
  const double a = dot(d, d);
  const double b = dot(d, to_center);
  const Vec3d nearest = to_center - d * (b / a);
  const double radius = sphere.radius;
  const double discriminant = radius * radius - dot(nearest, nearest);
  if (!(discriminant > 0)) return missed;
  const double root = std::sqrt(discriminant / a);
  const double grain = 0x1p-21 * std::max(radius, largest_coordinate(sphere.center));
  const double nearest_t = std::max(ray.t_near, grain / std::sqrt(a));
  const double t0 = b / a - root;
  if (t0 >= nearest_t && t0 <= ray.t_far) return t0;
  const double t1 = b / a + root;
  if (t1 >= nearest_t && t1 <= ray.t_far) return t1;
  return missed;
}

double hit_distance(const Disk& disk, const ShapeRay& ray) {
  const Vec3d center(disk.center);
  const double t = plane_distance(center, Vec3d(disk.normal), ray);
  if (t < 0) return missed;
  const Vec2<double> at = in_basis(ray.origin + ray.direction * t - center, Vec3d(disk.axis_x), Vec3d(disk.axis_y));
  return at.x * at.x + at.y * at.y <= 1 ? t : missed;
}

double hit_distance(const Cylinder& cylinder, const ShapeRay& ray) {
  const Vec3d axis(cylinder.axis);
  const Vec3d from_base = ray.origin - Vec3d(cylinder.base);
  const double along = dot(axis, from_base), climb = dot(axis, ray.direction);
  // The circle's problem in the plane across the axis.
  const Vec3d o = from_base - axis * along, d = ray.direction - axis * climb;
  const double a = dot(d, d);
  if (!(a > 0)) return missed;
  const double middle = -dot(d, o) / a;
  const Vec3d nearest = o + d * middle;
  const double radius = cylinder.radius;
  const double discriminant = radius * radius - dot(nearest, nearest);
  if (!(discriminant > 0)) return missed;
  const double root = std::sqrt(discriminant / a);
  const double grain = 0x1p-21 * std::max(radius, largest_coordinate(cylinder.base) + cylinder.length);
  const double nearest_t = std::max(ray.t_near, grain / length(ray.direction));
  for (const double t : {middle - root, middle + root}) {
    const double height = along + t * climb;
    if (t >= nearest_t && t <= ray.t_far && height >= 0 && height <= cylinder.length) return t;
  }
  return missed;
}

double hit_distance(const Plane& plane, const ShapeRay& ray) { return plane_distance(plane.point, plane.normal, ray); }

double hit_distance(const LongFace& face, const ShapeRay& ray) {
  const double t = (face.offset - dot(face.normal, ray.origin)) / dot(face.normal, ray.direction);
  if (!(t > 0 && t >= ray.t_near && t <= ray.t_far)) return missed;
  const Vec3d q = ray.origin + ray.direction * t - face.corner, n = cross(face.edge_u, face.edge_v);
  // By volumes rather than in_basis, whose determinant cancels where the edges are nearly parallel.
  const double nn = dot(n, n), u = dot(n, cross(q, face.edge_v)) / nn, v = dot(n, cross(face.edge_u, q)) / nn;
  constexpr double low = -1e-12, high = 1 - low;  // so that nothing slips between two faces that share an edge
  const bool inside = u >= low && v >= low && (face.is_triangle ? u + v <= high : u <= high && v <= high);
  return inside ? t : missed;
}

ShapePoint point_on(const Sphere& sphere, const Vec3d& near) {
  const Vec3f along = Vec3f(near) - sphere.center;
  const Vec3f p = sphere.center + along * (sphere.radius / length(along));
  return {p, normalize(sphere.normal_at(p))};
}

ShapePoint point_on(const Disk& disk, const Vec3d& near) {
  const Vec3d normal(disk.normal);
  return {Vec3f(near + normal * dot(normal, Vec3d(disk.center) - near)), disk.normal};
}

ShapePoint point_on(const Cylinder& cylinder, const Vec3d& near) {
  const Vec3d base(cylinder.base), axis(cylinder.axis);
  const double height = dot(axis, near - base);
  const Vec3d outward = normalize(near - base - axis * height);
  const Vec3f normal(outward);
  return {Vec3f(base + axis * height + outward * cylinder.radius), cylinder.inward ? -normal : normal};
}

ShapePoint point_on(const Plane& plane, const Vec3d& near) {
  return {Vec3f(near + plane.normal * dot(plane.normal, plane.point - near)), Vec3f(plane.normal)};
}

ShapePoint point_on(const LongFace& face, const Vec3d& near) {
  return {Vec3f(near + face.normal * (face.offset - dot(face.normal, near))), Vec3f(face.normal)};
}

ShapeBox box_around(const Sphere& sphere) {
  const Vec3f r(sphere.radius * (1 + 0x1p-20f));
  return {sphere.center - r, sphere.center + r};
}

ShapeBox box_around(const Disk& disk) {
  const auto reach = [](float x, float y) { return std::hypot(double{x}, double{y}); };
  const Vec3d r(reach(disk.axis_x.x, disk.axis_y.x), reach(disk.axis_x.y, disk.axis_y.y),
                reach(disk.axis_x.z, disk.axis_y.z));
  return padded(Vec3d(disk.center) - r, Vec3d(disk.center) + r);
}

ShapeBox box_around(const Cylinder& cylinder) {
  const Vec3d a(cylinder.base), b = a + Vec3d(cylinder.axis) * cylinder.length;
  const auto reach = [&](float along) { return cylinder.radius * std::sqrt(std::max(0.0, 1 - double{along} * along)); };
  const Vec3d r(reach(cylinder.axis.x), reach(cylinder.axis.y), reach(cylinder.axis.z));
  const Vec3d low{std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
  const Vec3d high{std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
  return padded(low - r, high + r);
}

ShapeBox box_around(const LongFace& face) {
  const Vec3d& corner = face.corner;
  Vec3d low = corner, high = corner;
  for (const Vec3d& p : {corner + face.edge_u, corner + face.edge_v, corner + face.edge_u + face.edge_v}) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  static constexpr double most = 1e18;  // Embree leaves out what reaches further
  const auto held = [](double x) { return std::clamp(x, -most, most); };
  return padded({held(low.x), held(low.y), held(low.z)}, {held(high.x), held(high.y), held(high.z)});
}

}  // namespace photonproof
