#include "renderer/shapes/cylinder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "renderer/lanes/warp.h"
#include "renderer/photons/surface_side.h"
#include "renderer/shapes/circle_area.h"
#include "renderer/shapes/extent.h"
#include "renderer/shapes/shape_place.h"
#include "renderer/shapes/sphere.h"
#include "scenes/base/numeric_faults.h"

namespace photonproof::inline renderer_shapes {
namespace {

/// Gauss-Legendre quadrature of six points: exact to 1e-9 here for integrands without a kink.
template <class Integrand>
double integrate(double from, double to, const Integrand& f) {
  constexpr std::array<double, 3> nodes{0.2386191860831969, 0.6612093864662645, 0.9324695142031521};
  constexpr std::array<double, 3> weights{0.4679139345726910, 0.3607615730481386, 0.1713244923791704};
  const double middle = (from + to) / 2, half = (to - from) / 2;
  double sum = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    sum += weights[i] * (f(middle - half * nodes[i]) + f(middle + half * nodes[i]));
  return sum * half;
}

}  // namespace

double hit_distance(const Cylinder& cylinder, const ShapeRay& ray) {
  const Vec3d& axis = cylinder.axis;
  const Vec3d from_base = ray.origin - cylinder.base;
  const double along = dot(axis, from_base), sweep_run = dot(axis, ray.direction);
  // The circle's problem in the plane across the axis.
  const Vec3d o = from_base - axis * along, d = ray.direction - axis * sweep_run;
  const double a = dot(d, d);
  if (!(a > 0)) return shape_missed;
  const double middle = -dot(d, o) / a;
  const Vec3d nearest = o + d * middle;
  const double radius = cylinder.radius;
  double discriminant = radius * radius - dot(nearest, nearest);
  if (has_fault(NumericFault::float_cylinder))
    discriminant = double{static_cast<float>(radius * radius) - static_cast<float>(dot(nearest, nearest))};
  if (!(discriminant > 0)) return shape_missed;
  const double root = std::sqrt(discriminant / a);
  const double largest = radius + largest_coordinate(cylinder.base) + cylinder.length;
  const double nearest_t = std::max(ray.t_near, grain_of_ray(ray, largest));
  const auto meets = [&](double t) {
    const double height = along + t * sweep_run;
    return t >= nearest_t && t <= ray.t_far && height >= 0 && height <= cylinder.length;
  };
  const double near = middle - root, far = middle + root;
  // As of a sphere.
  if (ray.on_light == OnLight::starts) return meets(2 * middle) ? 2 * middle : shape_missed;
  if (ray.on_light == OnLight::ends) return meets(near) && middle <= ray.t_far ? near : shape_missed;
  return meets(near) ? near : meets(far) ? far : shape_missed;
}

ShapePoint point_on(const Cylinder& cylinder, const Vec3d& near) {
  const Vec3d &base = cylinder.base, &axis = cylinder.axis;
  const double height = dot(axis, near - base);
  const Vec3d outward = normalize(near - base - axis * height);
  const Vec3f normal(outward);
  return {Vec3f(base + axis * height + outward * cylinder.radius), cylinder.inward ? -normal : normal};
}

ShapeBox box_around(const Cylinder& cylinder) {
  const Vec3d &a = cylinder.base, b = a + cylinder.axis * cylinder.length;
  const auto reach = [&](double along) { return cylinder.radius * std::sqrt(std::max(0.0, 1 - along * along)); };
  const Vec3d r(reach(cylinder.axis.x), reach(cylinder.axis.y), reach(cylinder.axis.z));
  const Vec3d low{std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
  const Vec3d high{std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
  return padded_box(low - r, high + r);
}

LocalGeometry local_geometry(const Cylinder&, const AffineMap& frame, const Vec3f& p, const Vec3f& normal) {
  const Vec3f local = frame.local_point(p);
  return {
      {turn_of(local.x, local.y), local.z}, frame.vector({-2 * pi * local.y, 2 * pi * local.x, 0}), frame.z, normal};
}

// Let s = r sin t be the distance from p across the axis; the line at the angle a = 2 asin(s/2R) about the axis lies
// there. Its part in the ball is r cos t long in both directions, or ends with the cylinder; R da = ds / sqrt(1 -
// (s/2R)^2).
float disc_area(const Cylinder& cylinder, const Vec3f& p, float radius) {
  const double big = cylinder.radius, r = radius;
  const double widest = std::min(r, big * std::sqrt(2 * accepted_versine(big, double{sheet_height} * r)));
  const double last = std::asin(std::min(1.0, widest / r)), k = r / (2 * big);
  const double below = std::clamp(dot(Vec3d(p) - cylinder.base, cylinder.axis), 0.0, cylinder.length);
  double area = 0;
  for (const double room : {below, cylinder.length - below}) {
    const double cut_until = room < r ? std::min(last, std::acos(room / r)) : 0;
    area += 2 * room * 2 * big * std::asin(std::min(1.0, k * std::sin(cut_until)));
    area += 2 * r * r * integrate(cut_until, last, [&](double t) {
              const double c = std::cos(t), s = k * std::sin(t);
              return c * c / std::sqrt(1 - s * s);
            });
  }
  return static_cast<float>(area);
}

PlacedShape<Cylinder> placed(const CylinderDescription& description, const ShapePlace& place) {
  place.require_similarity();
  const Transform& to_world = place.to_world;
  const Vec3d base = to_world.point(description.p0);
  const Vec3d along = to_world.point(description.p1) - base;
  const double radius = description.radius * to_world.similarity_scale();
  const double height = length(along);
  const Frame<float> around(Vec3f(normalize(description.p1 - description.p0)));
  const AffineMap uv(to_world.vector(Vec3d(around.s) * description.radius),
                     to_world.vector(Vec3d(around.t) * description.radius), along, base);
  return {
      {base, normalize(along), height, radius, place.shape.flip_normals}, uv, 2 * std::numbers::pi * radius * height};
}

Extent extent_of(const CylinderDescription& description, const Transform& to_world) {
  Extent extent;
  extent.add_ball(to_world, description.p0, description.radius);
  extent.add_ball(to_world, description.p1, description.radius);
  return extent;
}

Vec3d nearest_on(const CylinderDescription& description, const Transform& to_world, const Vec3d& to) {
  const Vec3d base = to_world.point(description.p0), along = to_world.point(description.p1) - base;
  const double share = std::clamp(dot(to - base, along) / dot(along, along), 0.0, 1.0);
  return nearest_on_ball(base + along * share, description.radius * to_world.similarity_scale(), to);
}

}  // namespace photonproof::inline renderer_shapes
