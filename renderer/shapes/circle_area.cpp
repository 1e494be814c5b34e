#include "renderer/shapes/circle_area.h"

#include <algorithm>
#include <cmath>

namespace photonproof::inline renderer_shapes {
namespace {

PlanePoint along(const PlanePoint& a, const PlanePoint& b, double t) {
  return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
}

/// Signed area of the triangle (origin, a, b) inside the circle about the origin: sectors where the edge is outside,
/// a triangle where it is inside.
double clipped_triangle(const PlanePoint& a, const PlanePoint& b, double radius) {
  const PlanePoint d{b.x - a.x, b.y - a.y};
  const double length2 = dot2(d, d);
  if (length2 == 0) return 0;
  const double half_b = dot2(a, d);
  const double discriminant = half_b * half_b - length2 * (dot2(a, a) - radius * radius);
  if (discriminant <= 0) return circle_sector(a, b, radius);
  const double root = std::sqrt(discriminant);
  const double enter = std::clamp((-half_b - root) / length2, 0.0, 1.0);
  const double leave = std::clamp((-half_b + root) / length2, 0.0, 1.0);
  if (enter >= leave) return circle_sector(a, b, radius);
  const PlanePoint p = along(a, b, enter);
  const PlanePoint q = along(a, b, leave);
  return circle_sector(a, p, radius) + 0.5 * cross2(p, q) + circle_sector(q, b, radius);
}

}  // namespace

double circle_sector(const PlanePoint& a, const PlanePoint& b, double radius) {
  return 0.5 * radius * radius * std::atan2(cross2(a, b), dot2(a, b));
}

double polygon_in_circle(std::span<const PlanePoint> polygon, double radius) {
  return polygon_in_circle(polygon, {0, 0}, radius);
}

double polygon_in_circle(std::span<const PlanePoint> polygon, const PlanePoint& middle, double radius) {
  const auto corner = [&](std::size_t i) -> PlanePoint { return {polygon[i].x - middle.x, polygon[i].y - middle.y}; };
  double area = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i)
    area += clipped_triangle(corner(i), corner((i + 1) % polygon.size()), radius);
  return std::abs(area);
}

}  // namespace photonproof::inline renderer_shapes
