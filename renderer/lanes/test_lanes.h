// Whether packs of lanes compute the same as one lane: every lane of a result is compared with the same function of
// float.
//
// Packs add in other orders and fuse other operations than float does, so the last digits may differ, and all of them
// where terms cancel. A lane may therefore be off by 1e-5, or by a few times the change of the scalar function when its
// inputs move by an ulp or four. Such lanes are counted, and must be few.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "renderer/lanes/lane.h"
#include "renderer/lanes/test_random.h"

namespace photonproof::test {

using Lanes = stdx::native_simd<float>;
inline constexpr std::size_t width = lane_count<Lanes>;

// --- inputs ----------------------------------------------------------------------------------------------------------

/// A float of either sign, its magnitude 10^-8 to 10^8, one in thirty special.
inline float anything(Random& random) {
  constexpr float inf = std::numeric_limits<float>::infinity();
  constexpr float special[] = {0, -0.0f, inf, -inf, std::numeric_limits<float>::quiet_NaN(), 1e-40f, -3e-39f, 1, -1};
  const Vec2<float> u = random.next2();
  if (u.x < 1.0f / 30) return special[static_cast<std::size_t>(9 * u.y)];
  const float magnitude = std::pow(10.0f, 16 * u.y - 8);
  return random.next() < 0.5f ? magnitude : -magnitude;
}
inline float positive(Random& random) { return std::abs(anything(random)); }
/// A number in [0,1), sometimes 0 or its greatest value.
inline float unit(Random& random) {
  const Vec2<float> u = random.next2();
  return u.x < 0.01f ? 0 : u.x < 0.02f ? 1 - 0x1p-24f : u.y;
}
inline Vec3f direction(Random& random) {
  const float z = 2 * random.next() - 1, phi = 6.2831853f * random.next();
  const float r = std::sqrt(std::max(0.0f, 1 - z * z));
  return {r * std::cos(phi), r * std::sin(phi), z};
}
/// A direction in three of four cases, else any vector.
inline Vec3f mostly_direction(Random& random) {
  if (random.next() < 0.75f) return direction(random);
  return {anything(random), anything(random), anything(random)};
}

// --- comparison ------------------------------------------------------------------------------------------------------

inline bool close(float a, float b) {
  if (std::isnan(a) || std::isnan(b)) return std::isnan(a) && std::isnan(b);
  if (a == b) return true;
  const float larger = std::max(std::abs(a), std::abs(b));
  return std::isfinite(larger) && std::abs(a - b) <= 1e-5f * larger + std::numeric_limits<float>::min();
}

template <std::size_t n>
using Floats = std::array<float, n>;

/// Whether `packed` lies within eight times the change of f when its inputs move by an ulp or four.
template <std::size_t n, std::size_t m, class Fn>
bool within_conditioning(const Fn& f, const Floats<n>& input, float packed, float scalar, std::size_t output) {
  Random random(71);
  float low = scalar, high = scalar;
  bool nan = std::isnan(scalar);
  for (int trial = 0; trial < 64; ++trial) {
    const float reach = trial % 2 == 0 ? 0x1p-23f : 0x1p-21f;
    Floats<n> moved = input;
    for (float& v : moved) v += v * (reach * (2 * random.next() - 1));
    const Floats<m> result = f(moved);
    nan = nan || std::isnan(result[output]);
    low = std::fmin(low, result[output]);
    high = std::fmax(high, result[output]);
  }
  if (std::isnan(packed) || std::isnan(scalar)) return nan && (std::isnan(packed) || packed >= low);
  const float reach = 8 * (high - low);
  return packed == low || packed == high || (packed >= low - reach && packed <= high + reach);
}

/// The function f, a template over F, maps an array of n inputs to an array of m results. `make(random)` makes a lane's
/// inputs.
template <std::size_t n, std::size_t m, class Fn, class Make>
void expect_lanes_agree(const std::string& name, const Fn& f, const Make& make, int inputs = 100'000) {
  int failures = 0, ill_conditioned = 0;
  for (int first = 0; first < inputs && failures < 5; first += static_cast<int>(width)) {
    std::array<Floats<n>, width> rows;
    std::array<Lanes, n> columns;
    for (std::size_t lane = 0; lane < width; ++lane) {
      Random random(70, static_cast<std::uint64_t>(first) + lane);
      rows[lane] = make(random);
      for (std::size_t k = 0; k < n; ++k) columns[k][lane] = rows[lane][k];
    }
    const std::array<Lanes, m> packed = f(columns);
    for (std::size_t lane = 0; lane < width; ++lane) {
      const Floats<m> scalar = f(rows[lane]);
      for (std::size_t k = 0; k < m; ++k) {
        const float p = packed[k][lane];
        if (close(p, scalar[k])) continue;
        if (within_conditioning<n, m>(f, rows[lane], p, scalar[k], k)) {
          ++ill_conditioned;
          continue;
        }
        if (++failures > 5) break;
        std::string text;
        for (const float v : rows[lane]) text += testing::PrintToString(v) + " ";
        ADD_FAILURE() << name << ": result " << k << " is " << p << " packed and " << scalar[k] << " alone, of "
                      << text;
      }
    }
  }
  EXPECT_LE(ill_conditioned, inputs * static_cast<int>(m) / 200) << name;
}

}  // namespace photonproof::test
