// Goodness of fit for samplers, test code only.
#pragma once

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "renderer/test_random.h"
#include "scenes/vec.h"

namespace photonproof::test {

/// p-value of Pearson's test of `observed` counts against `expected`. Cells expecting fewer than 5 are pooled.
inline double chi_square_p_value(const std::vector<double>& observed, const std::vector<double>& expected) {
  double statistic = 0, pooled_observed = 0, pooled_expected = 0;
  int cells = 0;
  for (std::size_t i = 0; i < observed.size(); ++i) {
    if (expected[i] < 5) {
      pooled_observed += observed[i];
      pooled_expected += expected[i];
      continue;
    }
    statistic += (observed[i] - expected[i]) * (observed[i] - expected[i]) / expected[i];
    ++cells;
  }
  if (pooled_expected >= 5) {
    statistic += (pooled_observed - pooled_expected) * (pooled_observed - pooled_expected) / pooled_expected;
    ++cells;
  } else if (pooled_observed > 5 * (pooled_expected + 1)) {
    return 0;  // samples where the density says there are next to none
  }
  if (cells < 2) return 1;
  return boost::math::cdf(boost::math::complement(boost::math::chi_squared(cells - 1), statistic));
}

/// Draws directions and compares their histogram over (cos theta, phi) with the integral of the density over each cell.
/// `draw(random)` gives a unit Vec3f; `density(direction)` is per solid angle and may integrate to less than 1. Cells
/// are integrated on a lattice of sub x sub points, which must be fine where the density jumps.
template <class Draw, class Density>
double direction_p_value(const Draw& draw, const Density& density, std::uint64_t seed, int samples = 200'000,
                         int sub = 8) {
  constexpr int rows = 20, columns = 24;
  std::vector<double> observed(rows * columns), expected(rows * columns);
  for (int i = 0; i < samples; ++i) {
    Random random(seed, static_cast<std::uint64_t>(i));
    const Vec3f d = draw(random);
    const int row = std::clamp(static_cast<int>((d.z + 1) / 2 * rows), 0, rows - 1);
    const double phi = std::atan2(d.y, d.x) / (2 * std::numbers::pi) + 0.5;
    const int column = std::clamp(static_cast<int>(phi * columns), 0, columns - 1);
    observed[static_cast<std::size_t>(row * columns + column)] += 1;
  }
  // Midpoint rule on a lattice of equal solid angles within each cell.
  for (int row = 0; row < rows * sub; ++row) {
    for (int column = 0; column < columns * sub; ++column) {
      const double z = (row + 0.5) / (rows * sub) * 2 - 1;
      const double phi = ((column + 0.5) / (columns * sub) - 0.5) * 2 * std::numbers::pi;
      const double r = std::sqrt(1 - z * z);
      const Vec3f d{static_cast<float>(r * std::cos(phi)), static_cast<float>(r * std::sin(phi)),
                    static_cast<float>(z)};
      const double solid_angle = 4 * std::numbers::pi / (rows * columns * sub * sub);
      expected[static_cast<std::size_t>(row / sub * columns + column / sub)] +=
          samples * solid_angle * static_cast<double>(density(d));
    }
  }
  return chi_square_p_value(observed, expected);
}

/// Sidak's level for one of `tests` tests at a family level of 0.01.
inline double sidak_level(int tests) { return 1 - std::pow(1 - 0.01, 1.0 / tests); }

}  // namespace photonproof::test
