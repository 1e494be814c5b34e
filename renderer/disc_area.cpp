#include "renderer/disc_area.h"

#include <array>
#include <cmath>
#include <numbers>

namespace photonproof {
namespace {

using Point = Vec2<double>;

double cross2(const Point& a, const Point& b) { return a.x * b.y - a.y * b.x; }
double dot2(const Point& a, const Point& b) { return a.x * b.x + a.y * b.y; }
Point along(const Point& a, const Point& b, double t) { return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)}; }

/// Signed area of the sector of the circle about the origin between the directions of a and b.
double sector(const Point& a, const Point& b, double radius) {
  return 0.5 * radius * radius * std::atan2(cross2(a, b), dot2(a, b));
}

/// Signed area of the triangle (origin, a, b) inside the circle about the origin: sectors where the edge is outside,
/// a triangle where it is inside.
double clipped_triangle(const Point& a, const Point& b, double radius) {
  const Point d{b.x - a.x, b.y - a.y};
  const double length2 = dot2(d, d);
  if (length2 == 0) return 0;
  const double half_b = dot2(a, d);
  const double discriminant = half_b * half_b - length2 * (dot2(a, a) - radius * radius);
  if (discriminant <= 0) return sector(a, b, radius);
  const double root = std::sqrt(discriminant);
  const double enter = std::clamp((-half_b - root) / length2, 0.0, 1.0);
  const double leave = std::clamp((-half_b + root) / length2, 0.0, 1.0);
  if (enter >= leave) return sector(a, b, radius);
  const Point p = along(a, b, enter);
  const Point q = along(a, b, leave);
  return sector(a, p, radius) + 0.5 * cross2(p, q) + sector(q, b, radius);
}

/// Whether p is at least `radius` away from all four edges, as most points are.
bool holds_whole_disc(const Quad& quad, const Vec3f& p, float radius) {
  const Vec3f from_corner = p - quad.corner;
  const auto far_from_pair = [&](const Vec3f& edge, const Vec3f& other) {
    // Twice the areas of the triangles that p makes with the edge and with the one opposite: edge length x distance.
    const Vec3f twice_area = cross(edge, from_corner);
    const Vec3f across = cross(edge, other);
    const float needed = radius * radius * length_squared(edge);
    return length_squared(twice_area) >= needed && length_squared(across - twice_area) >= needed;
  };
  return far_from_pair(quad.edge_u, quad.edge_v) && far_from_pair(quad.edge_v, quad.edge_u);
}

}  // namespace

float disc_area(const Quad& quad, const Vec3f& p, float radius) {
  if (holds_whole_disc(quad, p, radius)) return std::numbers::pi_v<float> * radius * radius;
  const Vec3d edge_u(quad.edge_u), edge_v(quad.edge_v);
  const Vec3d x_axis = normalize(edge_u);
  const Vec3d y_axis = normalize(edge_v - x_axis * dot(edge_v, x_axis));
  const Vec3d corner = Vec3d(quad.corner) - Vec3d(p);
  const std::array<Vec3d, 4> corners{corner, corner + edge_u, corner + edge_u + edge_v, corner + edge_v};
  std::array<Point, 4> polygon;
  for (std::size_t i = 0; i < 4; ++i) polygon[i] = {dot(corners[i], x_axis), dot(corners[i], y_axis)};

  double area = 0;
  for (std::size_t i = 0; i < 4; ++i) area += clipped_triangle(polygon[i], polygon[(i + 1) % 4], radius);
  return static_cast<float>(area);
}

float disc_area(const Sphere& sphere, const Vec3f&, float radius) {
  const float chord = std::min(radius, 2 * sphere.radius);
  return std::numbers::pi_v<float> * chord * chord;
}

}  // namespace photonproof
