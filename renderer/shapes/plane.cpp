#include "renderer/shapes/plane.h"

#include "renderer/lanes/warp.h"
#include "renderer/shapes/extent.h"
#include "renderer/shapes/shape_place.h"

namespace photonproof::inline renderer_shapes {

double hit_distance(const Plane& plane, const ShapeRay& ray) { return plane_distance(plane.point, plane.normal, ray); }

ShapePoint point_on(const Plane& plane, const Vec3d& near) {
  return {Vec3f(near + plane.normal * dot(plane.normal, plane.point - near)), Vec3f(plane.normal)};
}

ShapeBox box_around(const Plane&) { return {}; }

LocalGeometry local_geometry(const Plane&, const AffineMap& frame, const Vec3f& p, const Vec3f& normal) {
  return local_geometry_of_square(frame, p, normal);
}

float disc_area(const Plane&, const Vec3f&, float radius) { return pi * radius * radius; }

PlacedShape<Plane> placed(const PlaneDescription&, const ShapePlace& place) {
  const Vec3d origin = place.to_world.point({0, 0, 0});
  const Vec3d x = place.to_world.vector({1, 0, 0}), y = place.to_world.vector({0, 1, 0});
  const Vec3d normal = place.flat_normal(x, y);
  if (!is_finite(normal) || !is_finite(Vec3f(origin)))
    place.refuse("the plane is outside what single precision can hold");
  return {{origin, normal}, flat_frame(origin, x, y), std::nullopt};
}

Extent extent_of(const PlaneDescription&, const Transform&) { return {}; }

Vec3d nearest_on(const PlaneDescription&, const Transform& to_world, const Vec3d& to) {
  const Vec3d n = cross(to_world.vector({1, 0, 0}), to_world.vector({0, 1, 0}));
  return to + n * (dot(n, to_world.point({0, 0, 0}) - to) / dot(n, n));
}

}  // namespace photonproof::inline renderer_shapes
