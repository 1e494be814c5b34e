#include "renderer/lights/light_area_cylinder.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "renderer/lanes/warp.h"
#include "scenes/description/description.h"
#include "scenes/text/numeric_faults.h"

namespace photonproof {
namespace {

/// A cylinder's points by the angle about the axis from where p is, phi, and the height z above p, along the axis. Both
/// are drawn by the angle that they are seen under: with rho the distance of p from the axis and
/// D^2 = rho^2 + R^2 - 2 rho R cos(phi) that of the line at phi,
///   p(phi) ~ 1/D^2,   p(z | phi) ~ 1/(D^2 + z^2)
/// whose integrals are arc tangents. In double: of a lamp far away the differences of those are small. By the gap
/// rho - R and the versine 1 - cos(phi): of a lamp close by those are.
struct SeenCylinder {
  Vec3d from_axis, side, along;  ///< unit: to p, and the other two axes
  double rho, radius, low, high;
  double gap;          ///< rho - R
  double least_gap;    ///< of p on the cylinder
  double span;         ///< high - low, of which those two keep no digits where the lamp is a speck
  double stretch;      ///< (rho + R) / |rho - R|: the half-angle phi/2 is atan(tan(t) / stretch), t uniform
  double from, range;  ///< of t; empty where nothing shines on p

  SeenCylinder(const CylinderShape& s, const Vec3f& p) : radius(s.radius) {
    const Vec3d d = Vec3d(p) - s.base;
    along = normalize(s.axis);
    const double height = dot(d, along);
    const Vec3d across = d - along * height;
    rho = length(across);
    gap = rho - radius;
    least_gap = std::max(1e-9 * std::min(radius, length(Vec3d(p))), 1e-15 * radius);
    from_axis = rho > 0 ? across / rho : Vec3d(s.start);
    side = cross(along, from_axis);
    low = -height;
    span = length(s.axis);
    high = span - height;
    if (has_fault(NumericFault::lost_height)) span = double{static_cast<float>(high) - static_cast<float>(low)};
    if (s.sign > 0 && !(gap > 0)) {
      stretch = from = range = 0;
      return;
    }
    stretch = (rho + radius) / std::max(std::abs(gap), least_gap);
    if (!(gap > 0)) {
      from = -pi_d / 2;
      range = pi_d;
      return;
    }
    const double half = std::atan(std::sqrt(stretch));  // t at the silhouette, where cos(phi) = R / rho
    from = s.sign > 0 ? -half : half;
    range = s.sign > 0 ? 2 * half : pi_d - 2 * half;
  }
  double distance2(double versine) const {
    return std::max(gap * gap + 2 * rho * radius * versine, least_gap * least_gap);
  }
  /// Per area at phi and z.
  double density(double versine, double z) const {
    if (!(range > 0)) return 0;
    const double d2 = distance2(versine), d = std::sqrt(d2);
    const double angle = std::atan2(d * span, d2 + low * high);
    // dt/dphi = |rho^2 - R^2| / (2 D^2).
    const double of_line = std::max(std::abs(gap), least_gap) * (rho + radius) / (2 * d2 * range);
    return of_line * d / (angle * (d2 + z * z)) / radius;
  }
  double per_solid_angle(double versine, double z, double sign) const {
    const double d2 = distance2(versine) + z * z, facing = sign * (gap - rho * versine);  // d cos at the lamp
    return facing > 0 ? density(versine, z) * d2 * std::sqrt(d2) / facing : 0;
  }
};

}  // namespace

LightPoint<float> CylinderShape::sample(const Vec2<float>& u) const {
  const SinCos<float> angle = sincos_turn(u.x);
  const Vec3f outward = start * angle.cos + side * angle.sin;
  return {Vec3f(base + axis * double{u.y} + Vec3d(outward) * radius), outward * sign, u};
}
float CylinderShape::area() const { return static_cast<float>(2 * pi_d * radius * length(axis)); }

Vec2<float> CylinderShape::uv_at(const LightPoint<float>& at) const {
  const Vec3d d = Vec3d(at.p) - base;
  return {turn_of(static_cast<float>(dot(d, Vec3d(start))), static_cast<float>(dot(d, Vec3d(side)))),
          static_cast<float>(dot(d, axis) / dot(axis, axis))};
}

SeenPoint CylinderShape::sample_from(const Vec3f& p, const Vec2<float>& u) const {
  const SeenCylinder seen(*this, p);
  if (!(seen.range > 0)) {  // any point, which gives nothing
    const LightPoint<float> point = sample(u);
    return {point, point.p - p, 0};
  }
  const double t = seen.from + double{u.x} * seen.range;
  const double opposite = std::sin(t), adjacent = seen.stretch * std::cos(t), whole = std::hypot(opposite, adjacent);
  const double sin_half = opposite / whole, cos_half = adjacent / whole;  // of phi
  const double versine = 2 * sin_half * sin_half, sin_phi = 2 * sin_half * cos_half;
  const double d = std::sqrt(seen.distance2(versine));
  const double angle = std::atan2(d * seen.span, d * d + seen.low * seen.high);
  const double z = std::clamp(d * std::tan(std::atan2(seen.low, d) + double{u.y} * angle), seen.low, seen.high);
  const Vec3d outward = seen.from_axis * (1 - versine) + seen.side * sin_phi;
  const Vec3d offset =
      seen.side * (seen.radius * sin_phi) - seen.from_axis * (seen.gap + seen.radius * versine) + seen.along * z;
  LightPoint<float> at{Vec3f(Vec3d(p) + offset), Vec3f(outward) * sign};
  at.uv = uv_at(at);
  return {at, Vec3f(offset), static_cast<float>(seen.per_solid_angle(versine, z, double{sign}))};
}
float CylinderShape::pdf_from(const Vec3f& p, const LightPoint<float>& at) const {
  const SeenCylinder seen(*this, p);
  const Vec3d offset = Vec3d(at.p) - Vec3d(p), normal = Vec3d(at.normal) * double{sign};
  // The angle by the normal: far from the origin a thin cylinder's points have few digits of it. And normals have few
  // of a huge one's near the origin.
  const bool by_place = std::max(length(Vec3d(p)), length(Vec3d(at.p))) < radius;
  const Vec3d outward = by_place ? (offset + seen.from_axis * seen.rho) * (1 / radius) : normal;
  const double x = dot(outward, seen.from_axis), y = dot(by_place ? offset * (1 / radius) : normal, seen.side);
  const double cos_phi = x / std::hypot(x, y), sin_phi = y / std::hypot(x, y);
  const double versine = cos_phi > 0 ? sin_phi * sin_phi / (1 + cos_phi) : 1 - cos_phi;
  return static_cast<float>(
      seen.per_solid_angle(versine, std::clamp(dot(offset, seen.along), seen.low, seen.high), double{sign}));
}

LightBounds CylinderShape::bounds() const {
  const LightBounds line = round_bounds({Vec3f(base), Vec3f(base + axis)});
  const Vec3f reach(static_cast<float>(radius));
  return round_bounds(line.low - reach, line.high + reach);
}

CylinderShape light_shape(const Cylinder& cylinder, const ShapeDescription& shape, const Transform& to_world) {
  // Mitsuba turns the cylinder's local z to p1 - p0 by its own frame; u starts at that frame's first axis.
  const auto& c = std::get<CylinderDescription>(shape.geometry);
  const Vec3d along = c.p1 - c.p0;
  const Frame<float> frame(Vec3f(normalize(along)));
  const auto unit = [&](const Vec3f& local) { return Vec3f(normalize(to_world.vector(Vec3d(local)))); };
  return {cylinder.base, to_world.vector(along), unit(frame.s),
          unit(frame.t), cylinder.radius,        cylinder.inward ? -1.0f : 1.0f};
}

}  // namespace photonproof
