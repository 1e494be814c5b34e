#include "renderer/lights/light_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace photonproof::inline renderer_lights {
namespace {

constexpr float half_turn = pi;

Vec3f lower(const Vec3f& a, const Vec3f& b) { return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)}; }
Vec3f upper(const Vec3f& a, const Vec3f& b) { return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}; }

LightBounds flat(const Vec3f& low, const Vec3f& high, const Vec3f& normal) { return {low, high, normal, 0, pi / 2, 0}; }

}  // namespace

LightBounds parallelogram_bounds(const Vec3f& corner, const Vec3f& edge_u, const Vec3f& edge_v, const Vec3f& normal) {
  const Vec3f a = corner + edge_u, b = corner + edge_v, c = a + edge_v;
  return flat(lower(lower(corner, a), lower(b, c)), upper(upper(corner, a), upper(b, c)), normal);
}

LightBounds ellipse_bounds(const Vec3f& center, const Vec3f& half_axis_u, const Vec3f& half_axis_v,
                           const Vec3f& normal) {
  const Vec3f &u = half_axis_u, &v = half_axis_v;
  const Vec3f reach{std::hypot(u.x, v.x), std::hypot(u.y, v.y), std::hypot(u.z, v.z)};
  return flat(center - reach, center + reach, normal);
}

LightBounds round_bounds(const Vec3f& low, const Vec3f& high) { return {low, high, {0, 0, 1}, half_turn, pi / 2, 0}; }

std::optional<LightBounds> triangle_bounds(const Vec3f& a, const Vec3f& b, const Vec3f& c, const Vec3f& normal,
                                           float area) {
  if (!(area > 0) || !std::isfinite(max_component(normal))) return std::nullopt;
  LightBounds bounds = flat(lower(lower(a, b), c), upper(upper(a, b), c), normal);
  bounds.power = area;
  return bounds;
}

LightBounds round_bounds(const std::vector<Vec3f>& points) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  LightBounds bounds = round_bounds(Vec3f(infinity), Vec3f(-infinity));
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
  // Turns the wide axis towards the narrow one until the far sides are equally far.
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
  // The smallest angle of any normal to the direction to p, over all points of the box. It is the angle to the axis,
  // less the spread, less the angle that the box subtends, at least 0.
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

}  // namespace photonproof::inline renderer_lights
