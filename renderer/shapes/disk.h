// Discs.
#pragma once

#include "renderer/shapes/shape.h"

namespace photonproof::inline scenes_description {
struct DiskDescription;
}

namespace photonproof::inline renderer_shapes {

/// center + x axis_x + y axis_y for x^2 + y^2 <= 1: an ellipse where the axes differ in length or are not
/// perpendicular. `normal` as in Quad.
struct Disk {
  Vec3f center, axis_x, axis_y;
  Vec3f normal;
  static constexpr bool is_round = false;
  float curvature_radius() const { return flat_curvature; }
  bool sees_itself(bool) const { return false; }
};

double hit_distance(const Disk& disk, const ShapeRay& ray);
ShapePoint point_on(const Disk& disk, const Vec3d& near);
ShapeBox box_around(const Disk& disk);
LocalGeometry local_geometry(const Disk& disk, const AffineMap& frame, const Vec3f& p, const Vec3f& normal);
/// Exact except for parts shorter than a 32nd of the way around an ellipse.
float disc_area(const Disk& disk, const Vec3f& p, float radius);
PlacedShape<Disk> placed(const DiskDescription& description, const ShapePlace& place);
Extent extent_of(const DiskDescription& description, const Transform& to_world);

}  // namespace photonproof::inline renderer_shapes
