// Balls that light paths aim at, and the cones in which the balls are seen.
#pragma once

#include <cstdint>

#include "renderer/lanes/lane.h"
#include "renderer/lanes/warp.h"

namespace photonproof::inline renderer_shapes {

/// A ball that encloses a target of light paths.
struct ProjectionTarget {
  Vec3f center;
  float radius = 0;
  static constexpr std::uint32_t stride = 4;
};

template <class F>
struct ProjectionCone {
  Vec3<F> axis;     ///< unit
  F one_minus_cos;  ///< of the half-angle; 2, every direction, from within the ball

  /// Whether the cone holds a unit direction; one that was sampled in it counts as inside in spite of rounding. Tested
  /// by the chord, |a - b|^2 = 2 (1 - cos), since cosines near 1 resolve no angles below 3e-4.
  Mask<F> holds(const Vec3<F>& direction) const {
    constexpr float rounding = 4e-7f;
    const Vec3<F> apart = direction - axis;
    const F reach = lane_sqrt(F(2 * one_minus_cos)) + rounding;
    return dot(apart, apart) <= reach * reach;
  }
};

template <class F>
ProjectionCone<F> cone_towards(const Vec3<F>& center, const F& radius, const Vec3<F>& p) {
  const Vec3<F> to_center = center - p;
  const F distance2 = dot(to_center, to_center);
  const F sin2 = radius * radius / distance2;
  const Mask<F> outside = sin2 < 1;
  const F narrow = sin2 / (1 + lane_sqrt(lane_max(F(1 - sin2), F(0.0f))));
  const Vec3<F> axis = to_center * (1 / lane_sqrt(distance2));
  return {select(distance2 > 0, axis, Vec3<F>(F(0.0f), F(0.0f), F(1.0f))), select(outside, narrow, F(2.0f))};
}

/// From this many radii on, a direction in single precision may miss a ball.
inline constexpr float too_far_for_directions = 4096;

/// A path's line from a light's point into a ball. From too far away `point` is the line's nearest point to the ball's
/// centre, else the light's own.
template <class F>
struct AimedLine {
  Vec3<F> point, direction;  ///< unit
};

/// Whether a line meets the ball; one that was sampled through it counts as meeting it in spite of rounding.
template <class F>
Mask<F> meets(const AimedLine<F>& line, const Vec3<F>& center, const F& radius) {
  constexpr float rounding = 1 + 1e-6f;
  return length(cross(Vec3<F>(line.point - center), line.direction)) <= rounding * radius;
}

/// Samples uniformly in the cone in which the ball is seen from p, with the density `projection_pdf`.
template <class F>
AimedLine<F> aimed_line(const Vec3<F>& center, const F& radius, const Vec3<F>& p, const Vec2<F>& u) {
  const ProjectionCone<F> cone = cone_towards(center, radius, p);
  const Frame<F> frame(cone.axis);
  const Vec3<F> local = square_to_cone(u, cone.one_minus_cos);
  const F distance = length(Vec3<F>(center - p));
  const Mask<F> too_far = distance > too_far_for_directions * radius;
  const F across = distance / select(too_far, local.z, F(1.0f));
  const Vec3<F> near_center = center + frame.to_world(Vec3<F>(local.x * across, local.y * across, F(0.0f)));
  return {select(too_far, near_center, p), normalize(frame.to_world(local))};
}

/// Density per solid angle at p. For other lines from p, `point` is any point near the ball if the line meets it.
template <class F>
F projection_pdf(const Vec3<F>& center, const F& radius, const Vec3<F>& p, const AimedLine<F>& line) {
  const ProjectionCone<F> cone = cone_towards(center, radius, p);
  const Mask<F> too_far = length(Vec3<F>(center - p)) > too_far_for_directions * radius;
  const Mask<F> inside = (too_far && meets(line, center, radius)) || (!too_far && cone.holds(line.direction));
  return select(inside, 1 / (2 * pi * cone.one_minus_cos), F(0.0f));
}

}  // namespace photonproof::inline renderer_shapes
