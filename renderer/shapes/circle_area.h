// Areas of intersections of circles with other figures, for disc_area.
#pragma once

#include <algorithm>
#include <span>

#include "renderer/photons/surface_side.h"
#include "scenes/base/vec.h"

namespace photonproof::inline renderer_shapes {

using PlanePoint = Vec2<double>;  ///< in the plane of a circle about its middle

inline double cross2(const PlanePoint& a, const PlanePoint& b) { return a.x * b.y - a.y * b.x; }
inline double dot2(const PlanePoint& a, const PlanePoint& b) { return a.x * b.x + a.y * b.y; }

/// Signed area of the sector of the circle about the origin between the directions of a and b.
double circle_sector(const PlanePoint& a, const PlanePoint& b, double radius);

/// Area of the intersection of a polygon, in order around, with the circle about the origin.
double polygon_in_circle(std::span<const PlanePoint> polygon, double radius);
/// The same for a circle about another point.
double polygon_in_circle(std::span<const PlanePoint> polygon, const PlanePoint& middle, double radius);

/// 1 - cosine of the widest angle, about a centre or an axis, at which the surface side's test accepts a surface of
/// this radius. Both its normals and its distance to the tangent plane, `height`, depend on that angle.
inline double accepted_versine(double surface_radius, double height) {
  return std::min(1 - double{least_side_cosine}, height / surface_radius);
}

}  // namespace photonproof::inline renderer_shapes
