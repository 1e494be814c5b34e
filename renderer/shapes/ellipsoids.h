// Clouds of ellipsoids, of which rays meet the outside alone. Each is the unit ball under an affine map.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "renderer/shapes/shape.h"
#include "scenes/description/transform.h"
#include "scenes/ellipsoids/ellipsoid_cloud.h"

namespace photonproof::inline scenes_description {
struct EllipsoidsDescription;
}

namespace photonproof::inline renderer_shapes {

/// All ellipsoids of one shape.
struct Ellipsoids {
  struct Place {
    Vec3f center;
    std::array<Vec3f, 3> to_unit;  ///< rows of the linear map from the world, in which the scales are 1
    float reach = 0;               ///< semi-axes in terms of the scales; 0 where none of it is left

    Vec3d unit_vector(const Vec3d& v) const {
      return {dot(Vec3d(to_unit[0]), v), dot(Vec3d(to_unit[1]), v), dot(Vec3d(to_unit[2]), v)};
    }
    Vec3d unit_point(const Vec3d& p) const { return unit_vector(p - Vec3d(center)); }
    /// Squared distance of a line from the centre, in terms of the scales. `direction` has any length.
    double distance2_to_line(const Vec3d& origin, const Vec3d& direction) const;
  };
  std::shared_ptr<const EllipsoidCloud> cloud;
  std::vector<Place> places;  ///< one for each of the cloud's
  bool inward = false;        ///< the normals point to the centres

  static constexpr bool is_round = false;
  float curvature_radius() const { return 0; }
  bool sees_itself(bool) const { return true; }
};

/// The smallest t in the ray's range at which it enters the ellipsoid, or shape_missed.
double hit_distance(const Ellipsoids::Place& place, const ShapeRay& ray);
ShapePoint point_on(const Ellipsoids& ellipsoids, std::size_t i, const Vec3d& near);
/// A box that has no size at the centre where none of the ellipsoid is left.
ShapeBox box_around(const Ellipsoids::Place& place);
ShapeBox box_around(const Ellipsoids& ellipsoids);
/// Has no texture coordinates, as Mitsuba's.
LocalGeometry local_geometry(const Ellipsoids& ellipsoids, const Vec3f& normal);

/// An ellipsoid of a description in the world.
struct PlacedEllipsoid {
  Vec3d center;
  std::array<Vec3d, 3> axes;  ///< as long as its scales
  double reach;
};

/// The ellipsoids of a description, placed by its own to_world and then by an affine map `then`.
class PlacedEllipsoids {
 public:
  PlacedEllipsoids(const EllipsoidsDescription& description, const Transform& own, const Transform& then = {});

  std::size_t count() const;
  PlacedEllipsoid operator[](std::size_t i) const;

 private:
  const EllipsoidsDescription& description_;
  Transform own_, then_;
  std::array<Vec3d, 3> turn_;  ///< images of the axes under the turn of `own`
  double scale_;               ///< the mean scale of `own`, times the description's
};

Ellipsoids compiled_ellipsoids(const EllipsoidsDescription& description, const PlacedEllipsoids& placed, bool inward);
Extent extent_of(const EllipsoidsDescription& description, const Transform& to_world);
/// On the line from the nearest centre.
Vec3d nearest_on(const EllipsoidsDescription& description, const Transform& to_world, const Vec3d& to);

}  // namespace photonproof::inline renderer_shapes
