// The part of a flat shape that a solid covers, standing on it or sunk in it. No light lands there, so a gather beside
// the solid must not count it as area. Otherwise half of the light would be missing along the foot of a box, at any
// radius.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "renderer/shapes/circle_area.h"
#include "renderer/shapes/plane.h"
#include "renderer/shapes/quad.h"
#include "renderer/shapes/shape.h"
#include "renderer/shapes/sphere.h"

namespace photonproof::inline renderer_areas {

/// A parallelepiped or a ball, seen from outside.
struct Solid {
  Vec3d middle;
  std::array<Vec3d, 3> half_edges{};  ///< a parallelepiped's; all 0 for a ball
  double radius = 0;                  ///< a ball's

  /// The solid of a cube's six sides, in the compiler's order; empty where they face inward.
  static std::optional<Solid> of_cube(const std::array<const Quad*, 6>& sides);
  static std::optional<Solid> of_ball(const Sphere& sphere);

  /// Largest distance of its points from its middle, in all directions and along a unit vector.
  double reach() const;
  double reach_along(const Vec3d& direction) const;
  /// Whether p is inside; touching does not count.
  bool holds(const Vec3d& p) const;
  /// Distances below this count as touching.
  double grain() const { return 1e-5 * reach() + 1e-6 * largest_coordinate(middle); }
};

class Footprint {
 public:
  /// Empty where the solid does not meet the flat shape.
  static std::optional<Footprint> of(const Solid& solid, const Quad& flat);
  static std::optional<Footprint> of(const Solid& solid, const Plane& flat);

  /// Whether light cannot land there on the flat shape's front, or on its back.
  bool covers(bool behind) const { return behind ? back_ : front_; }
  /// Area of the intersection with the disc about p in the shape's plane.
  double in_disc(const Vec3d& p, double radius) const;
  double area() const;
  /// Around all points from which a disc of radius 0 could meet it.
  ShapeBox box() const { return padded_box(middle_ - Vec3d(reach_), middle_ + Vec3d(reach_)); }
  bool overlaps(const Footprint& other) const;

 private:
  Footprint(const Solid& solid, const Vec3d& normal, double height, std::vector<Vec3d> polygon);
  static std::optional<Footprint> within(const Solid& solid, const std::vector<Vec3d>& flat, const Vec3d& normal);

  std::vector<Vec3d> polygon_;  ///< convex
  Vec3d normal_, x_axis_, y_axis_;
  Vec3d middle_{0.0};
  std::vector<PlanePoint> about_middle_;  ///< the polygon, along the axes
  double reach_ = 0;                      ///< of the polygon about its middle
  bool front_, back_;
};

}  // namespace photonproof::inline renderer_areas
