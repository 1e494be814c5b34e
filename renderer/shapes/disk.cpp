#include "renderer/shapes/disk.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderer/lanes/warp.h"
#include "renderer/shapes/circle_area.h"
#include "renderer/shapes/extent.h"
#include "renderer/shapes/shape_place.h"

namespace photonproof::inline renderer_shapes {
namespace {

/// Coordinates of q in the basis of two vectors that span its plane, which need not be perpendicular.
Vec2<double> in_basis(const Vec3d& q, const Vec3d& a, const Vec3d& b) {
  const double aa = dot(a, a), ab = dot(a, b), bb = dot(b, b), qa = dot(q, a), qb = dot(q, b);
  const double det = aa * bb - ab * ab;
  return {(qa * bb - qb * ab) / det, (qb * aa - qa * ab) / det};
}

}  // namespace

double hit_distance(const Disk& disk, const ShapeRay& ray) {
  if (ray.on_light != OnLight::no) return shape_missed;
  const Vec3d center(disk.center);
  const double t = plane_distance(center, Vec3d(disk.normal), ray);
  if (t < 0) return shape_missed;
  const Vec2<double> at = in_basis(ray.origin + ray.direction * t - center, Vec3d(disk.axis_x), Vec3d(disk.axis_y));
  return at.x * at.x + at.y * at.y <= 1 ? t : shape_missed;
}

ShapePoint point_on(const Disk& disk, const Vec3d& near) {
  const Vec3d normal(disk.normal);
  return {Vec3f(near + normal * dot(normal, Vec3d(disk.center) - near)), disk.normal};
}

ShapeBox box_around(const Disk& disk) {
  const auto reach = [](float x, float y) { return std::hypot(double{x}, double{y}); };
  const Vec3d r(reach(disk.axis_x.x, disk.axis_y.x), reach(disk.axis_x.y, disk.axis_y.y),
                reach(disk.axis_x.z, disk.axis_y.z));
  return padded_box(Vec3d(disk.center) - r, Vec3d(disk.center) + r);
}

LocalGeometry local_geometry(const Disk&, const AffineMap& frame, const Vec3f& p, const Vec3f& normal) {
  const Vec3f local = frame.local_point(p);
  const float r = std::hypot(local.x, local.y);
  const float cos_phi = r > 0 ? local.x / r : 1, sin_phi = r > 0 ? local.y / r : 0;
  // One turn is one unit of v, and 2 pi r long.
  const float turn = 2 * std::numbers::pi_v<float> * r;
  return {{r, turn_of(local.x, local.y)},
          frame.vector({cos_phi, sin_phi, 0}),
          frame.vector({-sin_phi * turn, cos_phi * turn, 0}),
          normal};
}

// Directions around p in which the circle ends before the ellipse give sectors of the circle. The others give the area
// between p and an arc of the ellipse, which in the ellipse's own coordinates is an arc of the unit circle.
float disc_area(const Disk& disk, const Vec3f& p, float radius) {
  const Vec3d u(disk.axis_x), v(disk.axis_y), from_center = Vec3d(p) - Vec3d(disk.center);
  const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), r = radius;
  const double determinant = uu * vv - uv * uv;
  PlanePoint q{(vv * dot(u, from_center) - uv * dot(v, from_center)) / determinant,
               (uu * dot(v, from_center) - uv * dot(u, from_center)) / determinant};
  const double off = std::sqrt(dot2(q, q));
  const double least_axis = std::sqrt(std::max(0.0, (uu + vv - std::sqrt((uu - vv) * (uu - vv) + 4 * uv * uv)) / 2));
  if ((1 - off) * least_axis >= r) return static_cast<float>(std::numbers::pi * r * r);
  if (off > 1) q = {q.x / off, q.y / off};  // rounding

  // For the angle b of a direction in the ellipse's coordinates: the point where it leaves the unit circle, and its
  // distance.
  struct Exit {
    PlanePoint at;
    double distance;
  };
  const auto exit = [&](double b) -> Exit {
    const PlanePoint d{std::cos(b), std::sin(b)};
    const double qd = dot2(q, d);
    const double t = -qd + std::sqrt(std::max(0.0, qd * qd + 1 - dot2(q, q)));
    return {{q.x + t * d.x, q.y + t * d.y}, t * std::sqrt(uu * d.x * d.x + 2 * uv * d.x * d.y + vv * d.y * d.y)};
  };
  const Vec3d x_axis = normalize(u), y_axis = normalize(v - x_axis * dot(v, x_axis));
  const auto in_world = [&](double b) -> PlanePoint {  // the direction, in the disc's plane
    const Vec3d d = u * std::cos(b) + v * std::sin(b);
    return {dot(d, x_axis), dot(d, y_axis)};
  };
  const auto piece = [&](double from, double to, bool whole_circle) {
    if (whole_circle) return circle_sector(in_world(from), in_world(to), r);
    const PlanePoint a = exit(from).at, b = exit(to).at;
    const double triangle = cross2({a.x - q.x, a.y - q.y}, {b.x - q.x, b.y - q.y});
    const double segment = std::atan2(cross2(a, b), dot2(a, b)) - cross2(a, b);
    return 0.5 * (triangle + segment) * std::sqrt(determinant);
  };
  constexpr int steps = 32;
  double area = 0, from = 0;
  bool inside = exit(0).distance >= r;
  for (int i = 1; i <= steps; ++i) {
    const double to = 2 * std::numbers::pi * i / steps;
    const bool inside_there = exit(to).distance >= r;
    if (inside_there != inside) {
      double low = from, high = to;
      for (int halving = 0; halving < 40; ++halving) {
        const double middle = (low + high) / 2;
        ((exit(middle).distance >= r) == inside ? low : high) = middle;
      }
      area += piece(from, low, inside);
      from = low;
      inside = inside_there;
    }
    area += piece(from, to, inside);
    from = to;
  }
  return static_cast<float>(area);
}

PlacedShape<Disk> placed(const DiskDescription&, const ShapePlace& place) {
  const Vec3d center = place.to_world.point({0, 0, 0});
  const Vec3d x = place.to_world.vector({1, 0, 0}), y = place.to_world.vector({0, 1, 0});
  return {{Vec3f(center), Vec3f(x), Vec3f(y), Vec3f(place.flat_normal(x, y))},
          flat_frame(center, x, y),
          std::numbers::pi * length(cross(x, y))};
}

Extent extent_of(const DiskDescription&, const Transform& to_world) {
  Extent extent;
  extent.add_box(to_world, {-1, -1, 0}, {1, 1, 0});
  return extent;
}

}  // namespace photonproof::inline renderer_shapes
