#include "renderer/areas/footprint.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "scenes/meshes/convex_clip.h"

namespace photonproof::inline renderer_areas {
namespace {

constexpr int sides_of_circle = 64;

std::vector<HalfSpace> half_spaces_of(const Solid& solid) {
  std::vector<HalfSpace> sides;
  for (std::size_t i = 0; i < 3; ++i) {
    Vec3d normal = normalize(cross(solid.half_edges[(i + 1) % 3], solid.half_edges[(i + 2) % 3]));
    const double middle = dot(normal, solid.middle), half = std::abs(dot(normal, solid.half_edges[i]));
    sides.push_back({normal, middle + half + solid.grain()});
    sides.push_back({-normal, -middle + half + solid.grain()});
  }
  return sides;
}

/// Half-spaces of the sides of a convex polygon, in order around.
std::vector<HalfSpace> half_spaces_of(std::span<const Vec3d> polygon, const Vec3d& normal) {
  Vec3d middle(0.0);
  for (const Vec3d& p : polygon) middle += p / static_cast<double>(polygon.size());
  std::vector<HalfSpace> sides;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3d along = polygon[(i + 1) % polygon.size()] - polygon[i];
    if (!(dot(along, along) > 0)) continue;
    Vec3d outward = normalize(cross(along, normal));
    if (dot(outward, middle - polygon[i]) > 0) outward = -outward;
    sides.push_back({outward, dot(outward, polygon[i])});
  }
  return sides;
}

/// Two unit vectors that are perpendicular to the normal and to each other.
std::array<Vec3d, 2> axes_of_plane(const Vec3d& normal) {
  const Vec3d other = std::abs(normal.x) < 0.7 ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0);
  const Vec3d x = normalize(cross(other, normal));
  return {x, cross(normal, x)};
}

/// Polygon of the area of the circle in which a plane at `height` from its middle cuts a ball.
std::vector<Vec3d> cut_of_ball(const Solid& ball, const Vec3d& normal, double height) {
  const double circle = std::sqrt(std::max(0.0, ball.radius * ball.radius - height * height));
  constexpr double step = 2 * std::numbers::pi / sides_of_circle;
  const double corner = circle * std::sqrt(step / std::sin(step));
  const auto [x, y] = axes_of_plane(normal);
  std::vector<Vec3d> polygon;
  for (int i = 0; i < sides_of_circle; ++i)
    polygon.push_back(ball.middle - normal * height + x * (corner * std::cos(i * step)) +
                      y * (corner * std::sin(i * step)));
  return polygon;
}

}  // namespace

std::optional<Solid> Solid::of_cube(const std::array<const Quad*, 6>& sides) {
  // The third side's v leads away from the first side.
  const std::array<Vec3d, 3> half{Vec3d(sides[0]->edge_u) / 2, Vec3d(sides[0]->edge_v) / 2,
                                  Vec3d(sides[2]->edge_v) / 2};
  const Vec3d of_side = Vec3d(sides[0]->corner) + half[0] + half[1];
  const Solid solid{of_side + half[2], half};
  if (!(dot(Vec3d(sides[0]->normal), of_side - solid.middle) > 0)) return std::nullopt;
  return solid;
}

std::optional<Solid> Solid::of_ball(const Sphere& sphere) {
  if (sphere.inward) return std::nullopt;
  return Solid{sphere.center, {}, sphere.radius};
}

double Solid::reach() const { return radius + length(half_edges[0]) + length(half_edges[1]) + length(half_edges[2]); }

double Solid::reach_along(const Vec3d& direction) const {
  return radius + std::abs(dot(direction, half_edges[0])) + std::abs(dot(direction, half_edges[1])) +
         std::abs(dot(direction, half_edges[2]));
}

bool Solid::holds(const Vec3d& p) const {
  if (radius > 0) return length(p - middle) < radius - grain();
  return std::ranges::all_of(half_spaces_of(*this),
                             [&](const HalfSpace& side) { return dot(side.normal, p) < side.offset - 2 * grain(); });
}

Footprint::Footprint(const Solid& solid, const Vec3d& normal, double height, std::vector<Vec3d> polygon)
    : polygon_(std::move(polygon)), normal_(normal) {
  const double up = solid.reach_along(normal);
  front_ = height + up > solid.grain();
  back_ = height - up < -solid.grain();
  const auto axes = axes_of_plane(normal);
  x_axis_ = axes[0];
  y_axis_ = axes[1];
  for (const Vec3d& p : polygon_) middle_ += p / static_cast<double>(polygon_.size());
  for (const Vec3d& p : polygon_) {
    const Vec3d from_middle = p - middle_;
    about_middle_.push_back({dot(from_middle, x_axis_), dot(from_middle, y_axis_)});
    reach_ = std::max(reach_, length(from_middle));
  }
}

std::optional<Footprint> Footprint::within(const Solid& solid, const std::vector<Vec3d>& flat, const Vec3d& normal) {
  const double height = dot(normal, solid.middle - flat.front());
  if (!(std::abs(height) < solid.reach_along(normal) + solid.grain())) return std::nullopt;
  std::vector<Vec3d> polygon = solid.radius > 0
                                   ? clip_polygon(cut_of_ball(solid, normal, height), half_spaces_of(flat, normal))
                                   : clip_polygon(flat, half_spaces_of(solid));
  const double least = 1e-6 * solid.reach() * solid.reach();
  if (!(polygon_area(polygon) > least)) return std::nullopt;
  return Footprint(solid, normal, height, std::move(polygon));
}

std::optional<Footprint> Footprint::of(const Solid& solid, const Quad& flat) {
  const Vec3d corner(flat.corner), u(flat.edge_u), v(flat.edge_v);
  return within(solid, {corner, corner + u, corner + u + v, corner + v}, normalize(Vec3d(flat.normal)));
}

std::optional<Footprint> Footprint::of(const Solid& solid, const Plane& flat) {
  const auto [x, y] = axes_of_plane(flat.normal);
  const Vec3d below = solid.middle - flat.normal * dot(flat.normal, solid.middle - flat.point);
  const double reach = 2 * solid.reach();
  return within(solid,
                {below - (x + y) * reach, below + (x - y) * reach, below + (x + y) * reach, below + (y - x) * reach},
                flat.normal);
}

double Footprint::in_disc(const Vec3d& p, double radius) const {
  const double most = reach_ + radius;
  const Vec3d from_middle = p - middle_;
  if (length_squared(from_middle) >= most * most) return 0;
  return polygon_in_circle(about_middle_, {dot(from_middle, x_axis_), dot(from_middle, y_axis_)}, radius);
}

double Footprint::area() const { return polygon_area(polygon_); }

bool Footprint::overlaps(const Footprint& other) const {
  const std::vector<Vec3d> common = clip_polygon(polygon_, half_spaces_of(other.polygon_, normal_));
  return polygon_area(common) > 1e-6 * std::min(area(), other.area());
}

}  // namespace photonproof::inline renderer_areas
