#include "renderer/lights/light_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace photonproof {
namespace {

constexpr float half_turn = pi;

Vec3f lower(const Vec3f& a, const Vec3f& b) { return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)}; }
Vec3f upper(const Vec3f& a, const Vec3f& b) { return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}; }

LightBounds flat(const Vec3f& low, const Vec3f& high, const Vec3f& normal) { return {low, high, normal, 0, pi / 2, 0}; }
LightBounds round(const Vec3f& low, const Vec3f& high) { return {low, high, {0, 0, 1}, half_turn, pi / 2, 0}; }

LightBounds parallelogram(const Vec3f& corner, const Vec3f& edge_u, const Vec3f& edge_v, const Vec3f& normal) {
  const Vec3f a = corner + edge_u, b = corner + edge_v, c = a + edge_v;
  return flat(lower(lower(corner, a), lower(b, c)), upper(upper(corner, a), upper(b, c)), normal);
}

LightBounds ellipse(const Vec3f& center, const Vec3f& u, const Vec3f& v, const Vec3f& normal) {
  const Vec3f reach{std::hypot(u.x, v.x), std::hypot(u.y, v.y), std::hypot(u.z, v.z)};
  return flat(center - reach, center + reach, normal);
}

LightBounds shape_bounds(const QuadShape& s) { return parallelogram(s.corner, s.edge_u, s.edge_v, s.normal); }
LightBounds shape_bounds(const DiskShape& s) { return ellipse(s.center, s.half_axis_u, s.half_axis_v, s.normal); }
LightBounds shape_bounds(const SphereShape& s) { return round(s.center - Vec3f(s.radius), s.center + Vec3f(s.radius)); }
LightBounds shape_bounds(const CylinderShape& s) {
  const Vec3f end = s.base + s.axis;
  return round(lower(s.base, end) - Vec3f(s.radius), upper(s.base, end) + Vec3f(s.radius));
}
LightBounds shape_bounds(const MeshShape& s) { return box_around(s.positions()); }

LightBounds bounds_of(const QuadLight<float>& l) { return parallelogram(l.corner, l.edge_u, l.edge_v, l.normal); }
LightBounds bounds_of(const SphereLight<float>& l) {
  return round(l.center - Vec3f(l.radius), l.center + Vec3f(l.radius));
}
LightBounds bounds_of(const PointLight<float>& l) { return round(l.position, l.position); }
LightBounds bounds_of(const DiskLight<float>& l) { return ellipse(l.center, l.half_axis_u, l.half_axis_v, l.normal); }
LightBounds bounds_of(const SpotLight<float>& l) { return {l.position, l.position, l.axis, 0, l.cutoff, 0}; }
LightBounds bounds_of(const AreaLight& l) {
  return std::visit([](const auto& s) { return shape_bounds(s); }, l.shape());
}
LightBounds bounds_of(const IesLight& l) { return round(l.position(), l.position()); }
LightBounds bounds_of(const TexturedSpotLight& l) { return bounds_of(l.spot()); }

}  // namespace

std::optional<LightBounds> light_bounds(const Light& light) {
  const Rgb f = flux(light);
  const float power = (f.x + f.y + f.z) / 3;
  if (is_infinite(light) || !(power > 0)) return std::nullopt;
  LightBounds bounds = std::visit(
      [](const auto& l) -> LightBounds {
        if constexpr (std::decay_t<decltype(l)>::is_infinite)
          return {};
        else
          return bounds_of(l);
      },
      light);
  bounds.power = power;
  return bounds;
}

std::optional<LightBounds> triangle_bounds(const Vec3f& a, const Vec3f& b, const Vec3f& c, const Vec3f& normal,
                                           float area) {
  if (!(area > 0) || !std::isfinite(max_component(normal))) return std::nullopt;
  LightBounds bounds = flat(lower(lower(a, b), c), upper(upper(a, b), c), normal);
  bounds.power = area;
  return bounds;
}

LightBounds box_around(const std::vector<Vec3f>& points) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  LightBounds bounds = round(Vec3f(infinity), Vec3f(-infinity));
  for (const Vec3f& p : points) {
    bounds.low = lower(bounds.low, p);
    bounds.high = upper(bounds.high, p);
  }
  return bounds;
}

LightBounds merge(const LightBounds& a, const LightBounds& b) {
  LightBounds both{lower(a.low, b.low), upper(a.high, b.high), a.axis, half_turn, std::max(a.emission, b.emission),
                   a.power + b.power};
  const LightBounds& wide = a.spread >= b.spread ? a : b;
  const LightBounds& narrow = a.spread >= b.spread ? b : a;
  const float apart = angle_between(wide.axis, narrow.axis);
  if (std::min(apart + narrow.spread, half_turn) <= wide.spread) {  // one cone holds the other
    both.axis = wide.axis;
    both.spread = wide.spread;
    return both;
  }
  const float spread = (wide.spread + apart + narrow.spread) / 2;
  if (spread >= half_turn) return both;
  const Vec3f about = cross(wide.axis, narrow.axis);
  const float sine = length(about);
  if (!(sine > 1e-6f)) return both;  // opposite axes: any cone between them
  // The wide axis turned towards the narrow one until the far sides are equally far.
  const float turn = spread - wide.spread;
  const Vec3f across = cross(about / sine, wide.axis);
  both.axis = normalize(wide.axis * std::cos(turn) + across * std::sin(turn));
  both.spread = spread;
  return both;
}

LightImportance::LightImportance(const LightBounds& bounds)
    : center_((bounds.low + bounds.high) * 0.5f),
      axis_(bounds.axis),
      radius_(length(bounds.high - bounds.low) * 0.5f),
      power_(bounds.power) {
  const float spread = std::min(bounds.spread + slack, half_turn);
  cos_spread_ = std::cos(spread);
  sin_spread_ = spread < half_turn ? std::sin(spread) : 0;
  cos_emission_ = std::cos(std::min(bounds.emission, half_turn));
}

float LightImportance::at(const Vec3f& p) const {
  const Vec3f d = p - center_;
  const float distance2 = dot(d, d), radius2 = radius_ * radius_;
  const float nearest2 = std::max(distance2, radius2);
  if (distance2 <= radius2 || !(distance2 > 0)) return nearest2 > 0 ? power_ / nearest2 : power_;
  // The smallest angle that any normal can make with the direction to p, over all points of the box: that with the axis
  // less the spread, less what the box is seen under, no less than 0.
  struct Angle {
    float cos, sin;
    Angle less(float cos_other, float sin_other) const {
      if (cos >= cos_other) return {1, 0};
      return {cos * cos_other + sin * sin_other, sin * cos_other - cos * sin_other};
    }
  };
  const auto sine = [](float squared_cosine) { return std::sqrt(std::max(0.0f, 1 - squared_cosine)); };
  const float cos_axis = std::clamp(dot(axis_, d) / std::sqrt(distance2), -1.0f, 1.0f);
  const float seen2 = radius2 / distance2;
  const Angle angle =
      Angle{cos_axis, sine(cos_axis * cos_axis)}.less(cos_spread_, sin_spread_).less(sine(seen2), std::sqrt(seen2));
  if (angle.cos <= cos_emission_) return 0;
  return power_ * std::max(angle.cos, slack) / nearest2;
}

}  // namespace photonproof
