// Cylinders, open at both ends.
#pragma once

#include "renderer/shapes/shape.h"

namespace photonproof::inline scenes_description {
struct CylinderDescription;
}

namespace photonproof::inline renderer_shapes {

/// The points at distance `radius` from the segment base + [0, length] axis; no caps.
struct Cylinder {
  Vec3d base, axis;  ///< axis is unit; in double, as for a sphere
  double length, radius;
  bool inward;  ///< the normal points to the axis
  static constexpr bool is_round = true;
  float curvature_radius() const { return static_cast<float>(radius); }
  bool sees_itself(bool both_sides) const { return inward || both_sides; }
};

double hit_distance(const Cylinder& cylinder, const ShapeRay& ray);
ShapePoint point_on(const Cylinder& cylinder, const Vec3d& near);
ShapeBox box_around(const Cylinder& cylinder);
LocalGeometry local_geometry(const Cylinder& cylinder, const AffineMap& frame, const Vec3f& p, const Vec3f& normal);
/// Accurate to 1e-6.
float disc_area(const Cylinder& cylinder, const Vec3f& p, float radius);
PlacedShape<Cylinder> placed(const CylinderDescription& description, const ShapePlace& place);
Extent extent_of(const CylinderDescription& description, const Transform& to_world);
Vec3d nearest_on(const CylinderDescription& description, const Transform& to_world, const Vec3d& to);

}  // namespace photonproof::inline renderer_shapes
