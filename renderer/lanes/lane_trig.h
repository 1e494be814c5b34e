// Sine and cosine over lanes: the same polynomials on every instruction set and for one lane, so that results agree.
#pragma once

#include "renderer/lanes/lane.h"

namespace photonproof::inline renderer_lanes {

template <class F>
struct SinCos {
  F sin, cos;
};

/// |x| <= pi/4. Taylor polynomials to x^9 and x^8, whose remainders there, (pi/4)^11/11! = 2e-9 and
/// (pi/4)^10/10! = 2.5e-8, are below the rounding of a float.
template <class F>
SinCos<F> sincos_quarter(const F& x) {
  const F x2 = x * x;
  const F s = mul_add(x2, mul_add(x2, mul_add(x2, F(1.0f / 362880), F(-1.0f / 5040)), F(1.0f / 120)), F(-1.0f / 6));
  const F c = mul_add(x2, mul_add(x2, mul_add(x2, F(1.0f / 40320), F(-1.0f / 720)), F(1.0f / 24)), F(-0.5f));
  return {mul_add(x * x2, s, x), mul_add(x2, c, F(1.0f))};
}

/// Sine and cosine of 2 pi u for u in [0,1].
template <class F>
SinCos<F> sincos_turn(const F& u) {
  // Adding and taking away 1.5 x 2^23 rounds to an integer: the nearest quarter turn.
  const F quarters = (4 * u + 12582912.0f) - 12582912.0f;
  const SinCos<F> near = sincos_quarter(F((u - 0.25f * quarters) * 6.28318530717959f));
  const Mask<F> odd = quarters == 1.0f || quarters == 3.0f;
  const Mask<F> negative_sin = quarters == 2.0f || quarters == 3.0f;
  const Mask<F> negative_cos = quarters == 1.0f || quarters == 2.0f;
  const F s = select(odd, near.cos, near.sin);
  const F c = select(odd, near.sin, near.cos);
  return {select(negative_sin, -s, s), select(negative_cos, -c, c)};
}

/// Arc tangent of y / x for y >= 0, in [0, pi]; 0 where both are 0. Polynomial of Moshier's Cephes, to 2e-7.
template <class F>
F angle_of(const F& y, const F& x) {
  const F abs_x = lane_abs(x);
  const F large = lane_max(y, abs_x);
  const F ratio = lane_min(y, abs_x) / select(large > 0, large, F(1.0f));
  const Mask<F> steep = ratio > 0.41421356f;  // tan(pi/8): beyond it, around pi/4
  const F t = select(steep, (ratio - 1) / (ratio + 1), ratio);
  const F t2 = t * t;
  const F series =
      mul_add(t2, mul_add(t2, mul_add(t2, F(8.05374449538e-2f), F(-1.38776856032e-1f)), F(1.99777106478e-1f)),
              F(-3.33329491539e-1f));
  const F acute = mul_add(F(series * t2), t, t) + select(steep, F(0.785398163397f), F(0.0f));
  const F first_quadrant = select(y > abs_x, 1.57079632679f - acute, acute);
  return select(x < 0, 3.14159265359f - first_quadrant, first_quadrant);
}

/// Angle between unit vectors, in [0, pi]; small angles keep their digits.
template <class F>
F angle_between(const Vec3<F>& a, const Vec3<F>& b) {
  const Vec3<F> across = cross(a, b);
  return angle_of(F(lane_sqrt(dot(across, across))), F(dot(a, b)));
}

}  // namespace photonproof::inline renderer_lanes
