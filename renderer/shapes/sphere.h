// Spheres.
#pragma once

#include "renderer/shapes/shape.h"

namespace photonproof::inline scenes_description {
struct SphereDescription;
}

namespace photonproof::inline renderer_shapes {

struct Sphere {
  Vec3d center;  ///< in double, as the radius: single precision resolves no visible part of a planet-sized floor
  double radius;
  bool inward;  ///< the normal points to the centre
  static constexpr bool is_round = true;
  float curvature_radius() const { return static_cast<float>(radius); }
  bool sees_itself(bool both_sides) const { return inward || both_sides; }
};

double hit_distance(const Sphere& sphere, const ShapeRay& ray);
ShapePoint point_on(const Sphere& sphere, const Vec3d& near);
ShapeBox box_around(const Sphere& sphere);
LocalGeometry local_geometry(const Sphere& sphere, const AffineMap& frame, const Vec3f& p, const Vec3f& normal);
/// Points within the chord length `radius` of p have area pi radius^2 (Archimedes).
float disc_area(const Sphere& sphere, const Vec3f& p, float radius);
PlacedShape<Sphere> placed(const SphereDescription& description, const ShapePlace& place);
Extent extent_of(const SphereDescription& description, const Transform& to_world);
Vec3d nearest_on(const SphereDescription& description, const Transform& to_world, const Vec3d& to);
/// Point nearest to `to` on the ball around `center`.
Vec3d nearest_on_ball(const Vec3d& center, double radius, const Vec3d& to);

}  // namespace photonproof::inline renderer_shapes
