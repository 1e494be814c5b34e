#include "renderer/shapes/ellipsoids.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "renderer/shapes/extent.h"
#include "renderer/shapes/local_geometry.h"
#include "scenes/description/description.h"

namespace photonproof::inline renderer_shapes {
namespace {

using Columns = std::array<Vec3d, 3>;

Columns columns_of(const Transform& t) { return {t.vector({1, 0, 0}), t.vector({0, 1, 0}), t.vector({0, 0, 1})}; }

/// Rows of the inverse.
Columns inverse_rows(const Columns& m) {
  const double determinant = dot(m[0], cross(m[1], m[2]));
  return {cross(m[1], m[2]) / determinant, cross(m[2], m[0]) / determinant, cross(m[0], m[1]) / determinant};
}

double squared_norm(const Columns& m) { return dot(m[0], m[0]) + dot(m[1], m[1]) + dot(m[2], m[2]); }

/// The orthogonal factor of a polar decomposition, which may mirror, by Newton's iteration with Higham's (1986)
/// factors.
Columns orthogonal_factor(Columns m) {
  constexpr int most_steps = 25;
  for (int step = 0; step < most_steps; ++step) {
    const Columns inverse_transpose = inverse_rows(m);
    const double gamma = std::sqrt(std::sqrt(squared_norm(inverse_transpose) / squared_norm(m)));
    double change = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d next = m[k] * (gamma / 2) + inverse_transpose[k] * (0.5 / gamma);
      change += length_squared(next - m[k]);
      m[k] = next;
    }
    if (change < 1e-30) break;
  }
  return m;
}

/// The rotation of a unit quaternion, as the images of the axes.
Columns axes_of(const std::array<float, 4>& q) {
  const double x = double{q[0]}, y = double{q[1]}, z = double{q[2]}, w = double{q[3]};
  return {Vec3d{1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)},
          Vec3d{2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)},
          Vec3d{2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)}};
}

Vec3d combined(const Columns& m, const Vec3d& v) { return m[0] * v.x + m[1] * v.y + m[2] * v.z; }

/// Half the edges of the box around an ellipsoid of these axes.
Vec3d half_box(const Columns& axes) {
  const auto side = [](double a, double b, double c) { return std::sqrt(a * a + b * b + c * c); };
  return {side(axes[0].x, axes[1].x, axes[2].x), side(axes[0].y, axes[1].y, axes[2].y),
          side(axes[0].z, axes[1].z, axes[2].z)};
}

}  // namespace

// The parts along the line are subtracted first, since the origin may be many scales away.
double Ellipsoids::Place::distance2_to_line(const Vec3d& origin, const Vec3d& direction) const {
  const Vec3d o = unit_point(origin), d = unit_vector(direction);
  const Vec3d nearest = o - d * (dot(o, d) / dot(d, d));
  return dot(nearest, nearest);
}

double hit_distance(const Ellipsoids::Place& place, const ShapeRay& ray) {
  const Vec3d o = place.unit_point(ray.origin), d = place.unit_vector(ray.direction);
  const double a = dot(d, d), middle = -dot(o, d) / a;
  if (!(middle > 0)) return shape_missed;
  const Vec3d nearest = o + d * middle;
  const double reach = double{place.reach}, discriminant = reach * reach - dot(nearest, nearest);
  if (!(discriminant > 0)) return shape_missed;
  const double t = middle - std::sqrt(discriminant / a);
  return t >= std::max(ray.t_near, grain_of_ray(ray, 0)) && t <= ray.t_far ? t : shape_missed;
}

ShapePoint point_on(const Ellipsoids& ellipsoids, std::size_t i, const Vec3d& near) {
  const Ellipsoids::Place& place = ellipsoids.places[i];
  const Vec3d center(place.center), unit = place.unit_point(near);
  const Columns rows{Vec3d(place.to_unit[0]), Vec3d(place.to_unit[1]), Vec3d(place.to_unit[2])};
  const Vec3d outward = normalize(combined(rows, unit));  // the gradient of the squared distance
  return {Vec3f(center + (near - center) * (double{place.reach} / length(unit))),
          Vec3f(ellipsoids.inward ? -outward : outward)};
}

ShapeBox box_around(const Ellipsoids::Place& place) {
  const Columns rows{Vec3d(place.to_unit[0]), Vec3d(place.to_unit[1]), Vec3d(place.to_unit[2])};
  // The inverse's columns are those of inverse_rows transposed twice.
  const Columns axes = inverse_rows(rows);
  const Vec3d center(place.center), half = half_box(axes) * double{place.reach};
  return padded_box(center - half, center + half);
}

ShapeBox box_around(const Ellipsoids& ellipsoids) {
  ShapeBox box;
  for (const Ellipsoids::Place& place : ellipsoids.places)
    if (place.reach > 0) box.add(box_around(place));
  return box;
}

LocalGeometry local_geometry(const Ellipsoids&, const Vec3f& normal) {
  const Tangents around = any_tangents(normal);
  return {{0, 0}, around.s, around.t, normal};
}

PlacedEllipsoids::PlacedEllipsoids(const EllipsoidsDescription& description, const Transform& own,
                                   const Transform& then)
    : description_(description), own_(own), then_(then), turn_(orthogonal_factor(columns_of(own))) {
  // The symmetric factor's mean diagonal: that of the transpose of the turn times `own`.
  const Columns m = columns_of(own);
  scale_ = (dot(turn_[0], m[0]) + dot(turn_[1], m[1]) + dot(turn_[2], m[2])) / 3 * description.scale_factor;
}

std::size_t PlacedEllipsoids::count() const { return description_.cloud->ellipsoids.size(); }

PlacedEllipsoid PlacedEllipsoids::operator[](std::size_t i) const {
  const Ellipsoid& e = description_.cloud->ellipsoids[i];
  const std::array<double, 3> scales{double{e.scale.x}, double{e.scale.y}, double{e.scale.z}};
  Columns axes = axes_of(e.turn);
  for (std::size_t k = 0; k < 3; ++k) axes[k] = then_.vector(combined(turn_, axes[k]) * (scales[k] * scale_));
  return {then_.point(own_.point(Vec3d(e.center))), axes, description_.reach(i)};
}

Ellipsoids compiled_ellipsoids(const EllipsoidsDescription& description, const PlacedEllipsoids& placed, bool inward) {
  Ellipsoids made;
  made.cloud = description.cloud;
  made.inward = inward;
  made.places.reserve(placed.count());
  for (std::size_t i = 0; i < placed.count(); ++i) {
    const PlacedEllipsoid e = placed[i];
    const Columns rows = inverse_rows(e.axes);
    made.places.push_back(
        {Vec3f(e.center), {Vec3f(rows[0]), Vec3f(rows[1]), Vec3f(rows[2])}, static_cast<float>(e.reach)});
  }
  return made;
}

Extent extent_of(const EllipsoidsDescription& description, const Transform& to_world) {
  const PlacedEllipsoids placed(description, to_world);
  Extent extent;
  for (std::size_t i = 0; i < placed.count(); ++i) {
    const PlacedEllipsoid e = placed[i];
    if (!(e.reach > 0)) continue;
    const Vec3d half = half_box(e.axes) * e.reach;
    extent.add(e.center - half);
    extent.add(e.center + half);
  }
  return extent;
}

Vec3d nearest_on(const EllipsoidsDescription& description, const Transform& to_world, const Vec3d& to) {
  const PlacedEllipsoids placed(description, to_world);
  Vec3d nearest(0.0);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < placed.count(); ++i) {
    const PlacedEllipsoid e = placed[i];
    const Columns rows = inverse_rows(e.axes);
    const Vec3d way = to - e.center;
    const double in_scales = length(Vec3d{dot(rows[0], way), dot(rows[1], way), dot(rows[2], way)});
    const Vec3d p = e.center + (in_scales > e.reach ? way * (e.reach / in_scales) : way);
    if (const double distance2 = length_squared(p - to); e.reach > 0 && distance2 < least) {
      least = distance2;
      nearest = p;
    }
  }
  return nearest;
}

}  // namespace photonproof::inline renderer_shapes
