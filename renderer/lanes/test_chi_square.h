// Goodness of fit for samplers, test code only.
#pragma once

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "renderer/lanes/test_random.h"
#include "scenes/base/vec.h"

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
    return 0;  // samples where the density is almost 0
  }
  if (cells < 2) return 1;
  return boost::math::cdf(boost::math::complement(boost::math::chi_squared(cells - 1), statistic));
}

/// The integral of g(x, y) over a rectangle by the midpoint rule. Where quarters or corners differ the rectangle is
/// divided again, `depth` times at most, so that a jump of g is followed to 2^-depth of the rectangle.
template <class G>
double integrate_rectangle(const G& g, double x, double y, double width, double height, int depth) {
  double sum = 0, low = std::numeric_limits<double>::infinity(), high = 0;
  const auto look = [&](double across, double up) {
    const double value = g(x + width * across, y + height * up);
    low = std::min(low, value);
    high = std::max(high, value);
    return value;
  };
  for (int i = 0; i < 4; ++i) sum += look(i % 2 * 0.5 + 0.25, i / 2 * 0.5 + 0.25);
  if (depth > 0)
    for (int i = 0; i < 4; ++i) look(i % 2, i / 2);
  if (depth == 0 || high - low <= 0.01 * high) return sum / 4 * width * height;
  sum = 0;
  for (int i = 0; i < 4; ++i)
    sum += integrate_rectangle(g, x + width / 2 * (i % 2), y + height / 2 * (i / 2), width / 2, height / 2, depth - 1);
  return sum;
}

/// Directions within a cone, in coordinates whose cells have equal solid angles.
class DirectionCells {
 public:
  static constexpr int rows = 20, columns = 24;

  /// `reach`: 1 - cos of the cone's half-angle; 2 is the sphere.
  explicit DirectionCells(const Vec3f& axis = {0, 0, 1}, double reach = 2) : reach_(reach), n_(normalize(Vec3d(axis))) {
    const Vec3d aside = std::abs(n_.z) < 0.9 ? Vec3d(0, 0, -1) : Vec3d(0, 1, 0);
    s_ = normalize(cross(aside, n_));
    t_ = cross(n_, s_);
  }
  bool is_cone() const { return reach_ < 2; }
  double solid_angle() const { return 2 * std::numbers::pi * reach_; }

  /// Both in [0,1); `down` is (1 - cos) / reach, 1 and more outside of the cone.
  struct Place {
    double down, around;
  };
  Place place(const Vec3f& d) const {
    const Vec3d direction = normalize(Vec3d(d)), apart = direction - n_;
    return {dot(apart, apart) / 2 / reach_,
            std::atan2(dot(direction, t_), dot(direction, s_)) / (2 * std::numbers::pi) + 0.5};
  }
  Vec3f direction(const Place& at) const {
    const double versine = at.down * reach_, phi = (at.around - 0.5) * 2 * std::numbers::pi;
    const double r = std::sqrt(std::max(versine * (2 - versine), 0.0));
    return Vec3f(s_ * (r * std::cos(phi)) + t_ * (r * std::sin(phi)) + n_ * (1 - versine));
  }

 private:
  double reach_;
  Vec3d s_, t_, n_;
};

/// Samples directions and compares their histogram over cells of equal solid angles with the integral of the density
/// over each. `draw(random)` returns a unit Vec3f, or zeros for none; `density(direction)` is per solid angle and may
/// integrate to less than 1 over the sphere. If `cells` are a cone, the missing part must be beside the cone. Integrals
/// begin on a lattice of sub x sub rectangles in each cell, which must resolve every feature of the density.
template <class Draw, class Density>
double direction_p_value(const Draw& draw, const Density& density, std::uint64_t seed, int samples = 200'000,
                         int sub = 8, const DirectionCells& cells = DirectionCells()) {
  constexpr int rows = DirectionCells::rows, columns = DirectionCells::columns;
  std::vector<double> observed(rows * columns + 1), expected(rows * columns + 1);  // the last is beside the cone
  for (int i = 0; i < samples; ++i) {
    Random random(seed, static_cast<std::uint64_t>(i));
    const Vec3f d = draw(random);
    if (d == Vec3f(0.0f)) {
      if (cells.is_cone()) observed.back() += 1;
      continue;
    }
    const auto [down, around] = cells.place(d);
    const int row = static_cast<int>(down * rows);
    const int column = std::clamp(static_cast<int>(around * columns), 0, columns - 1);
    const bool beside = row >= rows && cells.is_cone();
    observed[static_cast<std::size_t>(beside ? rows * columns : std::min(row, rows - 1) * columns + column)] += 1;
  }
  constexpr int depth = 5;
  const auto at = [&](double down, double around) {
    return static_cast<double>(density(cells.direction({down, around})));
  };
  double inside = 0;
  for (int row = 0; row < rows * sub; ++row)
    for (int column = 0; column < columns * sub; ++column) {
      const double height = 1.0 / (rows * sub), width = 1.0 / (columns * sub);
      const double mass = integrate_rectangle([&](double x, double y) { return at(y, x); }, column * width,
                                              row * height, width, height, depth) *
                          cells.solid_angle();
      expected[static_cast<std::size_t>(row / sub * columns + column / sub)] += samples * mass;
      inside += mass;
    }
  // A single number against a sum over all cells: the allowed error of the sum itself is much more than its noise.
  if (cells.is_cone() && std::abs(observed.back() / samples - (1 - inside)) > 3e-3) return 0;
  observed.pop_back();
  expected.pop_back();
  return chi_square_p_value(observed, expected);
}

/// Sidak's level for one of `tests` tests at a family level of 0.01.
inline double sidak_level(int tests) { return 1 - std::pow(1 - 0.01, 1.0 / tests); }

}  // namespace photonproof::test
