#include "renderer/shapes/disc_area.h"

#include <algorithm>
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

/// Gauss and Legendre's quadrature of six points: for what has no kink it is exact to 1e-9 here.
template <class Integrand>
double integrate(double from, double to, const Integrand& f) {
  constexpr std::array<double, 3> nodes{0.2386191860831969, 0.6612093864662645, 0.9324695142031521};
  constexpr std::array<double, 3> weights{0.4679139345726910, 0.3607615730481386, 0.1713244923791704};
  const double middle = (from + to) / 2, half = (to - from) / 2;
  double sum = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    sum += weights[i] * (f(middle - half * nodes[i]) + f(middle + half * nodes[i]));
  return sum * half;
}

/// 1 - cosine of the widest angle about a centre or an axis at which a curved surface is still accepted: its normals
/// and its distance to the tangent plane, `height`, both go by it.
double accepted_versine(double surface_radius, double height) {
  return std::min(1 - double{least_sheet_cosine}, height / surface_radius);
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

double polygon_in_circle(std::span<const Point> polygon, double radius) {
  double area = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i)
    area += clipped_triangle(polygon[i], polygon[(i + 1) % polygon.size()], radius);
  return std::abs(area);
}

float disc_area(const Quad& quad, const Vec3f& p, float radius) {
  if (holds_whole_disc(quad, p, radius)) return std::numbers::pi_v<float> * radius * radius;
  const Vec3d edge_u(quad.edge_u), edge_v(quad.edge_v);
  const Vec3d x_axis = normalize(edge_u);
  const Vec3d y_axis = normalize(edge_v - x_axis * dot(edge_v, x_axis));
  const Vec3d corner = Vec3d(quad.corner) - Vec3d(p);
  const std::array<Vec3d, 4> corners{corner, corner + edge_u, corner + edge_u + edge_v, corner + edge_v};
  std::array<Point, 4> polygon;
  for (std::size_t i = 0; i < 4; ++i) polygon[i] = {dot(corners[i], x_axis), dot(corners[i], y_axis)};
  return static_cast<float>(polygon_in_circle(polygon, radius));
}

// At the angle a from p the sphere is 2 R sin(a/2) away from p and R (1 - cos a) from its tangent plane; the cap has
// the area 2 pi R^2 (1 - cos a).
float disc_area(const Sphere& sphere, const Vec3f&, float radius) {
  const double big = sphere.radius, chord = double{radius} / big;
  const double versine = std::min({chord * chord / 2, accepted_versine(big, double{sheet_height} * radius), 2.0});
  return static_cast<float>(2 * std::numbers::pi * big * big * versine);
}

// With s = r sin t the distance from p across the axis, what the ball takes of the line at the angle a = 2 asin(s/2R)
// about the axis is r cos t long in both directions, or ends where the cylinder does; R da = ds / sqrt(1 - (s/2R)^2).
float disc_area(const Cylinder& cylinder, const Vec3f& p, float radius) {
  const double big = cylinder.radius, r = radius;
  const double widest = std::min(r, big * std::sqrt(2 * accepted_versine(big, double{sheet_height} * r)));
  const double last = std::asin(std::min(1.0, widest / r)), k = r / (2 * big);
  const double below = std::clamp<double>(dot(p - cylinder.base, cylinder.axis), 0, cylinder.length);
  double area = 0;
  for (const double room : {below, cylinder.length - below}) {
    const double cut_until = room < r ? std::min(last, std::acos(room / r)) : 0;
    area += 2 * room * 2 * big * std::asin(std::min(1.0, k * std::sin(cut_until)));
    area += 2 * r * r * integrate(cut_until, last, [&](double t) {
              const double c = std::cos(t), s = k * std::sin(t);
              return c * c / std::sqrt(1 - s * s);
            });
  }
  return static_cast<float>(area);
}

// The directions around p in which the circle ends before the ellipse give sectors of the circle, the others what lies
// between p and an arc of the ellipse: in the ellipse's own coordinates an arc of the unit circle.
float disc_area(const Disk& disk, const Vec3f& p, float radius) {
  const Vec3d u(disk.axis_x), v(disk.axis_y), from_center = Vec3d(p) - Vec3d(disk.center);
  const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), r = radius;
  const double determinant = uu * vv - uv * uv;
  Point q{(vv * dot(u, from_center) - uv * dot(v, from_center)) / determinant,
          (uu * dot(v, from_center) - uv * dot(u, from_center)) / determinant};
  const double off = std::sqrt(dot2(q, q));
  const double least_axis = std::sqrt(std::max(0.0, (uu + vv - std::sqrt((uu - vv) * (uu - vv) + 4 * uv * uv)) / 2));
  if ((1 - off) * least_axis >= r) return static_cast<float>(std::numbers::pi * r * r);
  if (off > 1) q = {q.x / off, q.y / off};  // rounding

  // By the angle b of a direction in the ellipse's coordinates: where it leaves the unit circle, and how far that is.
  struct Exit {
    Point at;
    double distance;
  };
  const auto exit = [&](double b) -> Exit {
    const Point d{std::cos(b), std::sin(b)};
    const double qd = dot2(q, d);
    const double t = -qd + std::sqrt(std::max(0.0, qd * qd + 1 - dot2(q, q)));
    return {{q.x + t * d.x, q.y + t * d.y}, t * std::sqrt(uu * d.x * d.x + 2 * uv * d.x * d.y + vv * d.y * d.y)};
  };
  const Vec3d x_axis = normalize(u), y_axis = normalize(v - x_axis * dot(v, x_axis));
  const auto in_world = [&](double b) -> Point {  // the direction, in the disc's plane
    const Vec3d d = u * std::cos(b) + v * std::sin(b);
    return {dot(d, x_axis), dot(d, y_axis)};
  };
  const auto piece = [&](double from, double to, bool whole_circle) {
    if (whole_circle) return sector(in_world(from), in_world(to), r);
    const Point a = exit(from).at, b = exit(to).at;
    const double triangle = cross2({a.x - q.x, a.y - q.y}, {b.x - q.x, b.y - q.y});
    const double segment = std::atan2(cross2(a, b), dot2(a, b)) - cross2(a, b);
    return 0.5 * (triangle + segment) * std::sqrt(determinant);
  };
  constexpr int steps = 32;
  double area = 0, from = 0;
  bool inside = exit(0).distance >= r;
  for (int i = 1; i <= steps; ++i) {
    const double to = 2 * std::numbers::pi * i / steps;
    const bool inside_there = exit(to).distance >= r;
    if (inside_there != inside) {
      double low = from, high = to;
      for (int halving = 0; halving < 40; ++halving) {
        const double middle = (low + high) / 2;
        ((exit(middle).distance >= r) == inside ? low : high) = middle;
      }
      area += piece(from, low, inside);
      from = low;
      inside = inside_there;
    }
    area += piece(from, to, inside);
    from = to;
  }
  return static_cast<float>(area);
}

}  // namespace photonproof
