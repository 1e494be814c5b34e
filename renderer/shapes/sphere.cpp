#include "renderer/shapes/sphere.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderer/lanes/warp.h"
#include "renderer/photons/surface_side.h"
#include "renderer/shapes/circle_area.h"
#include "renderer/shapes/extent.h"
#include "renderer/shapes/shape_place.h"
#include "scenes/base/numeric_faults.h"

namespace photonproof::inline renderer_shapes {

double hit_distance(const Sphere& sphere, const ShapeRay& ray) {
  const Vec3d& d = ray.direction;
  const Vec3d to_center = sphere.center - ray.origin;
  const double a = dot(d, d);
  const double b = dot(d, to_center);
  const Vec3d nearest = to_center - d * (b / a);
  const double radius = sphere.radius;
  double discriminant = radius * radius - dot(nearest, nearest);
  if (has_fault(NumericFault::float_sphere))
    discriminant = double{static_cast<float>(radius * radius) - static_cast<float>(dot(nearest, nearest))};
  if (!(discriminant > 0)) return shape_missed;
  const double root = std::sqrt(discriminant / a);
  const double nearest_t = std::max(ray.t_near, grain_of_ray(ray, radius + largest_coordinate(sphere.center)));
  const double middle = b / a, t0 = middle - root;
  // A ray that leaves the inner side meets the other end of its chord; only the near side hides an end on the front.
  if (ray.on_light == OnLight::starts)
    return 2 * middle >= nearest_t && 2 * middle <= ray.t_far ? 2 * middle : shape_missed;
  if (ray.on_light == OnLight::ends) return t0 >= nearest_t && middle <= ray.t_far ? t0 : shape_missed;
  if (t0 >= nearest_t && t0 <= ray.t_far) return t0;
  const double t1 = middle + root;
  if (t1 >= nearest_t && t1 <= ray.t_far) return t1;
  return shape_missed;
}

ShapePoint point_on(const Sphere& sphere, const Vec3d& near) {
  const Vec3d outward = normalize(near - sphere.center);
  return {Vec3f(sphere.center + outward * sphere.radius), Vec3f(sphere.inward ? -outward : outward)};
}

ShapeBox box_around(const Sphere& sphere) {
  return padded_box(sphere.center - Vec3d(sphere.radius), sphere.center + Vec3d(sphere.radius));
}

LocalGeometry local_geometry(const Sphere&, const AffineMap& frame, const Vec3f& p, const Vec3f& normal) {
  const Vec3f local = frame.local_point(p);
  const float from_axis = std::hypot(local.x, local.y);
  const float cos_phi = from_axis > 0 ? local.x / from_axis : 1, sin_phi = from_axis > 0 ? local.y / from_axis : 0;
  return {{turn_of(local.x, local.y), std::atan2(from_axis, local.z) / pi},
          frame.vector({-2 * pi * local.y, 2 * pi * local.x, 0}),
          frame.vector({pi * local.z * cos_phi, pi * local.z * sin_phi, -pi * from_axis}),
          normal};
}

// At the angle a from p the sphere is 2 R sin(a/2) away from p and R (1 - cos a) from its tangent plane. The cap has
// the area 2 pi R^2 (1 - cos a).
float disc_area(const Sphere& sphere, const Vec3f&, float radius) {
  const double big = sphere.radius, chord = double{radius} / big;
  const double versine = std::min({chord * chord / 2, accepted_versine(big, double{sheet_height} * radius), 2.0});
  return static_cast<float>(2 * std::numbers::pi * big * big * versine);
}

PlacedShape<Sphere> placed(const SphereDescription& description, const ShapePlace& place) {
  place.require_similarity();
  const Transform& to_world = place.to_world;
  const double radius = description.radius * to_world.similarity_scale();
  const Vec3d center = to_world.point(description.center);
  const AffineMap uv(to_world.vector({description.radius, 0, 0}), to_world.vector({0, description.radius, 0}),
                     to_world.vector({0, 0, description.radius}), center);
  return {{center, radius, place.shape.flip_normals}, uv, 4 * std::numbers::pi * radius * radius};
}

Extent extent_of(const SphereDescription& description, const Transform& to_world) {
  Extent extent;
  extent.add_ball(to_world, description.center, description.radius);
  return extent;
}

Vec3d nearest_on_ball(const Vec3d& center, double radius, const Vec3d& to) {
  const Vec3d to_point = to - center;
  const double distance = length(to_point);
  return center + (distance > 0 ? to_point * (radius / distance) : Vec3d{radius, 0, 0});
}

Vec3d nearest_on(const SphereDescription& description, const Transform& to_world, const Vec3d& to) {
  return nearest_on_ball(to_world.point(description.center), description.radius * to_world.similarity_scale(), to);
}

}  // namespace photonproof::inline renderer_shapes
