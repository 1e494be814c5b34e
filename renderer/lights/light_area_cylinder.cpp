#include "renderer/lights/light_area_cylinder.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "renderer/lanes/warp.h"
#include "scenes/base/numeric_faults.h"
#include "scenes/description/description.h"

namespace photonproof::inline renderer_lights {
namespace {

/// Coordinates of a cylinder's points: phi, the angle about the axis from the azimuth of p, and z, the height above p
/// along the axis. The distance of p from the axis is rho. That from the line at phi is D, with
/// `D^2 = rho^2 + R^2 - 2 rho R cos(phi)`. Along a line z is sampled by the angle that it subtends,
/// p(z | phi) ~ 1/(D^2 + z^2).
///   From outside, phi is sampled by p(phi) ~ 1/D^2. Half of its integral is t: tan(phi/2) = tan(t) / stretch.
///   From within, it is sampled by the angle psi of its direction to the direction away from the axis.
/// Double precision is needed because differences of arc tangents are small for a distant light. For a close light the
/// gap rho - R and the versine 1 - cos(phi) are the small quantities, so these are used.
struct SeenCylinder {
  Vec3d from_axis, side, along;  ///< Unit vectors: towards p, and the other two axes.
  double rho, radius, low, high;
  double gap;        ///< The difference rho - R.
  double least_gap;  ///< Smallest gap, for p on the cylinder.
  double span;       ///< The difference high - low, whose digits those two lose where the light is tiny.
  bool within;
  double stretch = 0;          ///< from outside: (rho + R) / (rho - R)
  double from = 0, range = 0;  ///< range of t or psi; empty where nothing shines on p

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
    within = !(gap > 0);
    if (within && s.sign > 0) return;
    if (within) {
      range = 2 * pi_d;
      return;
    }
    stretch = (rho + radius) / std::max(gap, least_gap);
    const double half = std::atan(std::sqrt(stretch));  // t at the silhouette, where cos(phi) = R / rho
    from = s.sign > 0 ? -half : half;
    range = s.sign > 0 ? 2 * half : pi_d - 2 * half;
  }
  struct Line {
    double versine, sin_phi;
  };
  Line line(double u) const {
    const double angle = from + u * range, sine = std::sin(angle), cosine = std::cos(angle);
    if (within) {  // point where the ray at psi leaves the circle
      const double b = rho * cosine, root = std::sqrt(std::max(radius * radius - rho * rho * sine * sine, 0.0));
      const double distance = b > 0 ? -gap * (rho + radius) / (b + root) : root - b;
      return {-(gap + distance * cosine) / radius, distance * sine / radius};
    }
    const double whole = std::hypot(sine, stretch * cosine);
    const double sin_half = sine / whole, cos_half = stretch * cosine / whole;  // half of phi
    return {2 * sin_half * sin_half, 2 * sin_half * cos_half};
  }
  double distance2(double versine) const {
    return std::max(gap * gap + 2 * rho * radius * versine, least_gap * least_gap);
  }
  /// The angle that a line at distance d subtends.
  double angle(double d) const { return std::atan2(d * span, d * d + low * high); }
  double per_solid_angle(double versine, double z, double sign) const {
    const double facing = sign * (gap - rho * versine);  // D times the cosine at the light, across the axis
    if (!(range > 0 && facing > 0)) return 0;
    const double d2 = distance2(versine), d = std::sqrt(d2), to_point = std::sqrt(d2 + z * z);
    if (within) return to_point / (range * angle(d) * d);
    // dt/dphi = (rho^2 - R^2) / (2 D^2).
    const double of_line = std::max(gap, least_gap) * (rho + radius) / (2 * d2 * range);
    return of_line * d / angle(d) / radius * to_point / facing;
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
  if (!(seen.range > 0)) {  // any point, with density 0
    const LightPoint<float> point = sample(u);
    return {point, point.p - p, 0};
  }
  const auto [versine, sin_phi] = seen.line(double{u.x});
  const double d = std::sqrt(seen.distance2(versine)), angle = seen.angle(d);
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
  // The angle from the normal: far from the origin a thin cylinder's points have few digits of it. Near the origin a
  // huge cylinder's normals have few digits of it.
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
  // Mitsuba rotates the cylinder's local z to p1 - p0 by its own frame; u starts at that frame's first axis.
  const auto& c = std::get<CylinderDescription>(shape.geometry);
  const Vec3d along = c.p1 - c.p0;
  const Frame<float> frame(Vec3f(normalize(along)));
  const auto unit = [&](const Vec3f& local) { return Vec3f(normalize(to_world.vector(Vec3d(local)))); };
  return {cylinder.base, to_world.vector(along), unit(frame.s),
          unit(frame.t), cylinder.radius,        cylinder.inward ? -1.0f : 1.0f};
}

}  // namespace photonproof::inline renderer_lights
