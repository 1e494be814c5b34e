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
/// whose integrals are arc tangents. In double: of a lamp far away the differences of those are small.
struct SeenCylinder {
  Vec3d from_axis, side, along;  ///< unit: to p, and the other two axes
  double rho, radius, low, high;
  double span;         ///< high - low, of which those two keep no digits where the lamp is a speck
  double stretch;      ///< (rho + R) / |rho - R|: the half-angle phi/2 is atan(tan(t) / stretch), t uniform
  double from, range;  ///< of t; empty where nothing shines on p

  SeenCylinder(const CylinderShape& s, const Vec3f& p) : radius(s.radius) {
    const Vec3d axis(s.axis), d = Vec3d(p) - Vec3d(s.base);
    along = normalize(axis);
    const double height = dot(d, along);
    const Vec3d across = d - along * height;
    rho = length(across);
    from_axis = rho > 0 ? across / rho : Vec3d(s.start);
    side = cross(along, from_axis);
    low = -height;
    span = length(axis);
    high = span - height;
    if (has_fault(NumericFault::lost_height)) span = double{static_cast<float>(high) - static_cast<float>(low)};
    const bool outside = rho > radius;
    if (s.sign > 0 && !outside) {
      stretch = from = range = 0;
      return;
    }
    stretch = (rho + radius) / std::max(std::abs(rho - radius), 1e-9 * radius);
    if (!outside) {
      from = -pi_d / 2;
      range = pi_d;
      return;
    }
    const double half = t_of(std::acos(radius / rho));
    from = s.sign > 0 ? -half : half;
    range = s.sign > 0 ? 2 * half : pi_d - 2 * half;
  }
  double t_of(double phi) const { return std::atan(stretch * std::tan(phi / 2)); }
  double distance2(double cos_phi) const {
    const double gap = rho - radius;
    return std::max(gap * gap + 2 * rho * radius * (1 - cos_phi), 1e-18 * radius * radius);
  }
  /// Per area at phi and z.
  double density(double cos_phi, double z) const {
    if (!(range > 0)) return 0;
    const double d2 = distance2(cos_phi), d = std::sqrt(d2);
    const double angle = std::atan2(d * span, d2 + low * high);
    // dt/dphi = |rho^2 - R^2| / (2 D^2).
    const double of_line = std::max(std::abs(rho - radius), 1e-9 * radius) * (rho + radius) / (2 * d2 * range);
    return of_line * d / (angle * (d2 + z * z)) / radius;
  }
  double per_solid_angle(double cos_phi, double z, double sign) const {
    const double d2 = distance2(cos_phi) + z * z, facing = sign * (rho * cos_phi - radius);  // d cos at the lamp
    return facing > 0 ? density(cos_phi, z) * d2 * std::sqrt(d2) / facing : 0;
  }
};

}  // namespace

LightPoint<float> CylinderShape::sample(const Vec2<float>& u) const {
  const SinCos<float> angle = sincos_turn(u.x);
  const Vec3f outward = start * angle.cos + side * angle.sin;
  return {base + axis * u.y + outward * radius, outward * sign, u};
}
float CylinderShape::area() const { return 2 * pi * radius * length(axis); }

Vec2<float> CylinderShape::uv_at(const LightPoint<float>& at) const {
  const Vec3f d = at.p - base;
  return {turn_of(dot(d, start), dot(d, side)), dot(d, axis) / dot(axis, axis)};
}

SeenPoint CylinderShape::sample_from(const Vec3f& p, const Vec2<float>& u) const {
  const SeenCylinder seen(*this, p);
  if (!(seen.range > 0)) {  // any point, which gives nothing
    const LightPoint<float> point = sample(u);
    return {point, point.p - p, 0};
  }
  const double t = seen.from + double{u.x} * seen.range;
  const double phi = 2 * std::atan2(std::sin(t), seen.stretch * std::cos(t));
  const double cos_phi = std::cos(phi), sin_phi = std::sin(phi), d = std::sqrt(seen.distance2(cos_phi));
  const double angle = std::atan2(d * seen.span, d * d + seen.low * seen.high);
  const double z = std::clamp(d * std::tan(std::atan2(seen.low, d) + double{u.y} * angle), seen.low, seen.high);
  const Vec3d outward = seen.from_axis * cos_phi + seen.side * sin_phi;
  const Vec3d offset = outward * seen.radius - seen.from_axis * seen.rho + seen.along * z;
  LightPoint<float> at{Vec3f(Vec3d(p) + offset), Vec3f(outward) * sign};
  at.uv = uv_at(at);
  return {at, Vec3f(offset), static_cast<float>(seen.per_solid_angle(cos_phi, z, double{sign}))};
}
float CylinderShape::pdf_from(const Vec3f& p, const LightPoint<float>& at) const {
  const SeenCylinder seen(*this, p);
  // The angle by the normal: far from the origin a thin cylinder's points have few digits of it.
  const Vec3d outward = Vec3d(at.normal) * double{sign};
  const double x = dot(outward, seen.from_axis), y = dot(outward, seen.side),
               z = dot(Vec3d(at.p) - Vec3d(p), seen.along);
  return static_cast<float>(
      seen.per_solid_angle(x / std::hypot(x, y), std::clamp(z, seen.low, seen.high), double{sign}));
}

LightBounds CylinderShape::bounds() const {
  const LightBounds line = round_bounds({base, base + axis});
  return round_bounds(line.low - Vec3f(radius), line.high + Vec3f(radius));
}

CylinderShape light_shape(const Cylinder& cylinder, const ShapeDescription& shape, const Transform& to_world) {
  // Mitsuba turns the cylinder's local z to p1 - p0 by its own frame; u starts at that frame's first axis.
  const auto& c = std::get<CylinderDescription>(shape.geometry);
  const Vec3d along = c.p1 - c.p0;
  const Frame<float> frame(Vec3f(normalize(along)));
  const auto unit = [&](const Vec3f& local) { return Vec3f(normalize(to_world.vector(Vec3d(local)))); };
  return {Vec3f(cylinder.base), Vec3f(to_world.vector(along)),       unit(frame.s),
          unit(frame.t),        static_cast<float>(cylinder.radius), cylinder.inward ? -1.0f : 1.0f};
}

}  // namespace photonproof
