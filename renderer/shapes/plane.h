// Infinite planes.
#pragma once

#include "renderer/shapes/shape.h"

namespace photonproof::inline scenes_description {
struct PlaneDescription;
}

namespace photonproof::inline renderer_shapes {

/// Every x with normal . (x - point) = 0.
struct Plane {
  Vec3d point, normal;  ///< unit
  static constexpr bool is_round = false;
  float curvature_radius() const { return flat_curvature; }
  bool sees_itself(bool) const { return false; }
};

double hit_distance(const Plane& plane, const ShapeRay& ray);
ShapePoint point_on(const Plane& plane, const Vec3d& near);
ShapeBox box_around(const Plane& plane);
LocalGeometry local_geometry(const Plane& plane, const AffineMap& frame, const Vec3f& p, const Vec3f& normal);
float disc_area(const Plane& plane, const Vec3f& p, float radius);
PlacedShape<Plane> placed(const PlaneDescription& description, const ShapePlace& place);
Extent extent_of(const PlaneDescription& description, const Transform& to_world);
Vec3d nearest_on(const PlaneDescription& description, const Transform& to_world, const Vec3d& to);

}  // namespace photonproof::inline renderer_shapes
