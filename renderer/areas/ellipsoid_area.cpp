#include "renderer/areas/ellipsoid_area.h"

#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "renderer/photons/surface_side.h"
#include "renderer/shapes/local_geometry.h"

namespace photonproof::inline renderer_areas {
namespace {

constexpr int points_of_other = 256;  ///< for an ellipsoid that the gather is not on
constexpr double golden_angle = 2.39996322972865332;

/// The gradient of half the squared distance from the centre in scales, at that offset in scales.
Vec3d gradient(const Ellipsoids::Place& place, const Vec3d& unit) {
  return Vec3d(place.to_unit[0]) * unit.x + Vec3d(place.to_unit[1]) * unit.y + Vec3d(place.to_unit[2]) * unit.z;
}

}  // namespace

struct EllipsoidArea::Gather {
  Vec3d p, normal;
  double radius;

  /// Whether a gather counts photons at this offset from p, where the unit outward normal has this cosine to its own.
  bool counts(const Vec3d& offset, double cosine) const {
    return cosine >= double{least_side_cosine} && length_squared(offset) <= radius * radius &&
           std::abs(dot(offset, normal)) <= double{sheet_height} * radius;
  }
};

namespace {

/// The cosine of the normals' angle between p and the point of its ellipsoid over this foot in p's tangent plane. Empty
/// where there is no such point, or where `counts` is false.
template <class Counts>
std::optional<double> cosine_over(const Ellipsoids::Place& place, const Vec3d& p, const Vec3d& normal,
                                  const Vec3d& foot, const Counts& counts) {
  const Vec3d o = place.unit_point(p + foot), d = place.unit_vector(normal);
  const double a = dot(d, d), b = dot(o, d), reach = double{place.reach};
  const double discriminant = b * b - a * (dot(o, o) - reach * reach);
  if (!(discriminant > 0)) return std::nullopt;
  const double height = (-b + std::sqrt(discriminant)) / a;
  const Vec3d g = gradient(place, o + d * height);
  const double cosine = dot(g, normal) / length(g);
  if (!counts(foot + normal * height, cosine)) return std::nullopt;
  return cosine;
}

/// Over p's tangent plane in polar coordinates. Along each direction the points that count end once; the area element
/// 1 / cosine is integrated over the squared distance.
template <class Counts>
double area_around(const Ellipsoids::Place& place, const Vec3d& p, const Vec3d& normal, double radius,
                   const Counts& counts) {
  constexpr int directions = 32, halvings = 30;
  constexpr std::array<double, 4> gauss_nodes{0.0694318442029737, 0.3300094782075719, 0.6699905217924281,
                                              0.9305681557970263};
  constexpr std::array<double, 4> gauss_weights{0.1739274225687269, 0.3260725774312731, 0.3260725774312731,
                                                0.1739274225687269};
  const Tangents plane = any_tangents(Vec3f(normal));
  double area = 0;
  for (int i = 0; i < directions; ++i) {
    const double angle = 2 * std::numbers::pi * (i + 0.5) / directions;
    const Vec3d along = Vec3d(plane.s) * std::cos(angle) + Vec3d(plane.t) * std::sin(angle);
    double low = 0, high = radius;
    for (int k = 0; k < halvings; ++k) {
      const double middle = (low + high) / 2;
      (cosine_over(place, p, normal, along * middle, counts) ? low : high) = middle;
    }
    for (std::size_t k = 0; k < gauss_nodes.size(); ++k)
      if (const auto cosine = cosine_over(place, p, normal, along * (low * std::sqrt(gauss_nodes[k])), counts))
        area += gauss_weights[k] * low * low / *cosine;
  }
  return area * std::numbers::pi / directions;
}

/// Over points of the gather's disc on a spiral of the golden angle.
template <class Counts>
double area_over_disc(const Ellipsoids::Place& place, const Vec3d& p, const Vec3d& normal, double radius,
                      const Counts& counts) {
  const Tangents plane = any_tangents(Vec3f(normal));
  double area = 0;
  for (int i = 0; i < points_of_other; ++i) {
    const double r = radius * std::sqrt((i + 0.5) / points_of_other), angle = golden_angle * i;
    const Vec3d foot = (Vec3d(plane.s) * std::cos(angle) + Vec3d(plane.t) * std::sin(angle)) * r;
    if (const auto cosine = cosine_over(place, p, normal, foot, counts)) area += 1 / *cosine;
  }
  return area * std::numbers::pi * radius * radius / points_of_other;
}

/// Over points of the unit sphere on a spiral of the golden angle, each with the area of its image.
template <class Counts>
double area_by_points(const Ellipsoids::Place& place, const Vec3d& p, const Vec3d& normal, const Counts& counts) {
  const std::array<Vec3d, 3> rows{Vec3d(place.to_unit[0]), Vec3d(place.to_unit[1]), Vec3d(place.to_unit[2])};
  const double determinant = dot(rows[0], cross(rows[1], rows[2])), reach = double{place.reach};
  const std::array<Vec3d, 3> axes{cross(rows[1], rows[2]) / determinant, cross(rows[2], rows[0]) / determinant,
                                  cross(rows[0], rows[1]) / determinant};
  double area = 0;
  for (int i = 0; i < points_of_other; ++i) {
    const double z = 1 - (2 * i + 1.0) / points_of_other, r = std::sqrt(1 - z * z), angle = golden_angle * i;
    const Vec3d unit{r * std::cos(angle), r * std::sin(angle), z};
    const Vec3d g = gradient(place, unit);
    const Vec3d q = Vec3d(place.center) + (axes[0] * unit.x + axes[1] * unit.y + axes[2] * unit.z) * reach;
    const double steep = length(g);
    // The map stretches the sphere's area elements by the gradient's length over the determinant.
    if (counts(q - p, dot(g, normal) / steep)) area += steep;
  }
  return area * reach * reach / std::abs(determinant) * 4 * std::numbers::pi / points_of_other;
}

}  // namespace

EllipsoidArea::EllipsoidArea(const Ellipsoids& ellipsoids) : ellipsoids_(ellipsoids) {
  std::vector<std::uint32_t> numbers;  // of those that have a surface
  std::vector<BoxTree::Part> parts;
  for (std::uint32_t i = 0; i < ellipsoids.places.size(); ++i) {
    if (!(ellipsoids.places[i].reach > 0)) continue;
    numbers.push_back(i);
    parts.push_back({box_around(ellipsoids.places[i]), ellipsoids.places[i].center});
  }
  tree_ = BoxTree(parts, order_);
  for (std::uint32_t& place : order_) place = numbers[place];
}

double EllipsoidArea::part_of(const Gather& at, const Ellipsoids::Place& place) {
  const auto counts = [&](const Vec3d& offset, double cosine) { return at.counts(offset, cosine); };
  const Vec3d unit = place.unit_point(at.p), g = gradient(place, unit);
  // Its height over the ellipsoid, to first order, beside what single precision can tell.
  const double height = (dot(unit, unit) - double{place.reach} * double{place.reach}) / (2 * length(g));
  const bool is_on = std::abs(height) < 1e-3 * at.radius && dot(g, at.normal) > 0.999 * length(g);
  if (is_on) return area_around(place, at.p, at.normal, at.radius, counts);
  const ShapeBox box = box_around(place);
  return double{length(box.high - box.low)} > at.radius ? area_over_disc(place, at.p, at.normal, at.radius, counts)
                                                        : area_by_points(place, at.p, at.normal, counts);
}

double EllipsoidArea::within(const Vec3f& p, const Vec3f& outward, float radius) const {
  const Gather at{Vec3d(p), Vec3d(outward), double{radius}};
  double area = 0;
  tree_.visit_near(p, radius, [&](std::uint32_t place) { area += part_of(at, ellipsoids_.places[order_[place]]); });
  return area;
}

}  // namespace photonproof::inline renderer_areas
