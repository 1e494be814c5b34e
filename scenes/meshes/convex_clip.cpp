#include "scenes/meshes/convex_clip.h"

#include <array>

namespace photonproof::inline scenes_meshes {
namespace {

double distance_to_segment(const Vec3d& p, const Vec3d& a, const Vec3d& edge) {
  const double squared = length_squared(edge);
  const double along = squared > 0 ? std::clamp(dot(p - a, edge) / squared, 0.0, 1.0) : 0;
  return length(p - a - edge * along);
}

}  // namespace

std::vector<Vec3d> clip_polygon(std::vector<Vec3d> polygon, std::span<const HalfSpace> region) {
  for (const HalfSpace& half : region) {
    std::vector<Vec3d> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec3d& a = polygon[i];
      const Vec3d& b = polygon[(i + 1) % polygon.size()];
      const double outside_a = dot(half.normal, a) - half.offset;
      const double outside_b = dot(half.normal, b) - half.offset;
      if (outside_a <= 0) kept.push_back(a);
      if ((outside_a < 0 && outside_b > 0) || (outside_a > 0 && outside_b < 0))
        kept.push_back(a + (b - a) * (outside_a / (outside_a - outside_b)));
    }
    polygon = std::move(kept);
  }
  return polygon;
}

double polygon_area(std::span<const Vec3d> polygon) {
  Vec3d sum{0, 0, 0};
  for (std::size_t i = 2; i < polygon.size(); ++i) sum += cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
  return 0.5 * length(sum);
}

double distance_to_parallelogram(const Vec3d& p, const Vec3d& corner, const Vec3d& edge_u, const Vec3d& edge_v) {
  // Foot of the perpendicular: p - corner = s u + t v + w n, solved with n = u x v.
  const Vec3d n = cross(edge_u, edge_v);
  const double nn = length_squared(n);
  const Vec3d d = p - corner;
  const double s = dot(cross(d, edge_v), n) / nn;
  const double t = dot(cross(edge_u, d), n) / nn;
  if (s >= 0 && s <= 1 && t >= 0 && t <= 1) return std::abs(dot(d, n)) / std::sqrt(nn);
  return std::min({distance_to_segment(p, corner, edge_u), distance_to_segment(p, corner, edge_v),
                   distance_to_segment(p, corner + edge_u, edge_v), distance_to_segment(p, corner + edge_v, edge_u)});
}

double distance_to_triangle(const Vec3d& p, const std::array<Vec3d, 3>& triangle) {
  const auto& [a, b, c] = triangle;
  // As above; without area the foot is not a number, and an edge is nearest.
  const Vec3d u = b - a, v = c - a, d = p - a;
  const Vec3d n = cross(u, v);
  const double nn = length_squared(n);
  const double s = dot(cross(d, v), n) / nn;
  const double t = dot(cross(u, d), n) / nn;
  if (s >= 0 && t >= 0 && s + t <= 1) return std::abs(dot(d, n)) / std::sqrt(nn);
  return std::min({distance_to_segment(p, a, u), distance_to_segment(p, a, v), distance_to_segment(p, b, c - b)});
}

}  // namespace photonproof::inline scenes_meshes
