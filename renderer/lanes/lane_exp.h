// Exponential, logarithm and the error function over lanes: the same polynomials on every instruction set and
// for one lane, so that results agree. No exceptions: arguments beyond a function's range give its nearest value.
#pragma once

#include "renderer/lanes/lane.h"

namespace photonproof::inline renderer_lanes {

/// Within 2 ulp; 0 below -87.3, where floats lose digits, and e^88 above 88.
template <class F>
F lane_exp(const F& x) {
  const F inside = lane_min(lane_max(x, F(-87.3f)), F(88.0f));
  // Adding and taking away 1.5 x 2^23 gives the nearest integer to x / ln 2. The value ln 2 is in two parts, the first
  // of few bits, so that its multiples are exact (Cody and Waite 1980).
  const F n = (inside * 1.44269504f + 12582912.0f) - 12582912.0f;
  const F r = mul_add(n, F(2.12194440e-4f), mul_add(n, F(-0.693359375f), inside));
  // Taylor to r^7: |r| <= 0.347 leaves 0.347^8/8! = 5e-9.
  F p = mul_add(r, F(1.0f / 5040), F(1.0f / 720));
  p = mul_add(r, mul_add(r, p, F(1.0f / 120)), F(1.0f / 24));
  p = mul_add(r, mul_add(r, p, F(1.0f / 6)), F(0.5f));
  p = mul_add(r, mul_add(r, p, F(1.0f)), F(1.0f));
  const F power = from_word<F>(UInt<F>(to_uint(F(n + 127.0f)) << 23));
  return select(x < -87.3f, F(0.0f), F(p * power));
}

/// Natural logarithm within 2 ulp; about -87.3 for arguments below 1.2e-38.
template <class F>
F lane_log(const F& x) {
  const UInt<F> bits = to_word(lane_max(x, F(1.17549435e-38f)));
  const F mantissa = from_word<F>(UInt<F>((bits & 0x7FFFFFu) | 0x3F800000u));  // [1, 2)
  const F exponent = to_float(UInt<F>(bits >> 23)) - 127.0f;
  const Mask<F> large = mantissa > 1.41421356f;
  const F m = select(large, F(0.5f * mantissa), mantissa);
  const F n = select(large, F(exponent + 1), exponent);
  // log m = 2 artanh s with s = (m-1)/(m+1), |s| <= 0.172; the series to s^9 leaves 2 s^11/11 = 7e-10.
  const F s = (m - 1) / (m + 1), s2 = s * s;
  const F series = mul_add(s2, mul_add(s2, mul_add(s2, F(2.0f / 9), F(2.0f / 7)), F(2.0f / 5)), F(2.0f / 3));
  const F log_m = mul_add(F(s * s2), series, F(2 * s));
  return mul_add(n, F(0.693359375f), mul_add(n, F(-2.12194440e-4f), log_m));
}

/// exp(x^2) erfc(x) for x >= 0, with a relative error below 3e-7: t P(2t-1) with t = 1/(1 + x/2), P interpolating at
/// Chebyshev's nodes.
template <class F>
F lane_erfcx(const F& x) {
  const F t = 1 / mul_add(x, F(0.5f), F(1.0f));
  const F u = 2 * t - 1;
  F p = mul_add(u, F(-1.3273958e-6f), F(4.2161197e-5f));
  p = mul_add(u, mul_add(u, p, F(-3.2951533e-5f)), F(-2.9938271e-4f));
  p = mul_add(u, mul_add(u, p, F(4.2702015e-4f)), F(1.5291572e-3f));
  p = mul_add(u, mul_add(u, p, F(-3.2418549e-3f)), F(-1.0751626e-2f));
  p = mul_add(u, mul_add(u, p, F(1.8221384e-2f)), F(1.3973573e-1f));
  p = mul_add(u, mul_add(u, p, F(3.4358033e-1f)), F(5.1079136e-1f));
  return t * p;
}

/// Within 3e-7.
template <class F>
F lane_erf(const F& x) {
  const F magnitude = lane_min(lane_abs(x), F(9.0f));
  const F tail = lane_exp(F(-magnitude * magnitude)) * lane_erfcx(magnitude);
  return lane_copysign(F(1 - tail), x);
}

/// For |x| < 1; finite beyond. Giles 2010, "Approximating the erfinv function", single precision.
template <class F>
F lane_erfinv(const F& x) {
  const F w = -lane_log(F((1 - x) * (1 + x)));
  const F a = w - 2.5f, b = lane_sqrt(lane_max(w, F(0.0f))) - 3;
  F near = mul_add(a, F(2.81022636e-08f), F(3.43273939e-07f));
  near = mul_add(a, mul_add(a, near, F(-3.5233877e-06f)), F(-4.39150654e-06f));
  near = mul_add(a, mul_add(a, near, F(0.00021858087f)), F(-0.00125372503f));
  near = mul_add(a, mul_add(a, near, F(-0.00417768164f)), F(0.246640727f));
  near = mul_add(a, near, F(1.50140941f));
  F far = mul_add(b, F(-0.000200214257f), F(0.000100950558f));
  far = mul_add(b, mul_add(b, far, F(0.00134934322f)), F(-0.00367342844f));
  far = mul_add(b, mul_add(b, far, F(0.00573950773f)), F(-0.0076224613f));
  far = mul_add(b, mul_add(b, far, F(0.00943887047f)), F(1.00167406f));
  far = mul_add(b, far, F(2.83297682f));
  return x * select(w < 5, near, far);
}

}  // namespace photonproof::inline renderer_lanes
