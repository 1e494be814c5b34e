// Balls that light paths are sent into, and the cones in which they are seen.
#pragma once

#include <cstdint>

#include "renderer/lanes/lane.h"

namespace photonproof {

/// A ball that holds what is aimed at.
struct AimTarget {
  Vec3f center;
  float radius = 0;
  static constexpr std::uint32_t stride = 4;
};

template <class F>
struct AimCone {
  Vec3<F> axis;     ///< unit
  F one_minus_cos;  ///< of the half-angle; 2, every direction, from within the ball

  /// Of a unit direction; one that was drawn in it is, whatever rounding made of it. By the chord, since cosines near 1
  /// tell no angles below 3e-4: |a - b|^2 = 2 (1 - cos).
  Mask<F> holds(const Vec3<F>& direction) const {
    constexpr float rounding = 4e-7f;
    const Vec3<F> apart = direction - axis;
    const F reach = lane_sqrt(F(2 * one_minus_cos)) + rounding;
    return dot(apart, apart) <= reach * reach;
  }
};

template <class F>
AimCone<F> cone_towards(const Vec3<F>& center, const F& radius, const Vec3<F>& p) {
  const Vec3<F> to_center = center - p;
  const F distance2 = dot(to_center, to_center);
  const F sin2 = radius * radius / distance2;
  const Mask<F> outside = sin2 < 1;
  const F narrow = sin2 / (1 + lane_sqrt(lane_max(F(1 - sin2), F(0.0f))));
  const Vec3<F> axis = to_center * (1 / lane_sqrt(distance2));
  return {select(distance2 > 0, axis, Vec3<F>(F(0.0f), F(0.0f), F(1.0f))), select(outside, narrow, F(2.0f))};
}

}  // namespace photonproof
