// Elementary functions compared with the C library's in double precision, over the ranges stated in their comments.

#include "renderer/lanes/lane_exp.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace photonproof::inline renderer_lanes {
namespace {

/// Largest |f(x) - truth(x)| / |truth(x)| on an even grid.
template <class Fn, class Truth>
double worst_relative(double from, double to, const Fn& f, const Truth& truth, int steps = 200'000) {
  double worst = 0;
  for (int i = 0; i <= steps; ++i) {
    const auto x = static_cast<float>(from + (to - from) * i / steps);
    const double expected = truth(static_cast<double>(x));
    worst = std::max(worst, std::abs(static_cast<double>(f(x)) - expected) / std::max(1e-300, std::abs(expected)));
  }
  return worst;
}
constexpr double ulp = 0x1p-23;  // at most, relatively

TEST(lane_exp, exponential_is_within_two_ulp) {
  EXPECT_LT(worst_relative(
                -87.2, 88, [](float x) { return lane_exp(x); }, [](double x) { return std::exp(x); }),
            2 * ulp);
  EXPECT_EQ(lane_exp(0.0f), 1);
  EXPECT_EQ(lane_exp(-1000.0f), 0);
  EXPECT_EQ(lane_exp(-std::numeric_limits<float>::infinity()), 0);
  EXPECT_TRUE(std::isfinite(lane_exp(1e30f)));
}

TEST(lane_exp, logarithm_is_within_two_ulp) {
  for (const auto& [from, to] : {std::pair{1e-6, 0.9}, {1.1, 100.0}, {1e3, 1e30}})
    EXPECT_LT(worst_relative(
                  from, to, [](float x) { return lane_log(x); }, [](double x) { return std::log(x); }),
              2 * ulp)
        << from;
  // About 1, where it passes through 0, too.
  EXPECT_LT(worst_relative(
                0.9, 0.99999, [](float x) { return lane_log(x); }, [](double x) { return std::log(x); }),
            2 * ulp);
  EXPECT_EQ(lane_log(1.0f), 0);
  EXPECT_NEAR(lane_log(0.0f), -87.3365f, 1e-3f);
}

TEST(lane_exp, error_functions_are_within_3e_7) {
  EXPECT_LT(worst_relative(
                0, 5, [](float x) { return lane_erfcx(x); }, [](double x) { return std::exp(x * x) * std::erfc(x); }),
            3.1e-7);
  double worst = 0;
  for (int i = -60'000; i <= 60'000; ++i) {
    const float x = static_cast<float>(i) * 1e-4f;
    worst = std::max(worst, std::abs(static_cast<double>(lane_erf(x)) - std::erf(static_cast<double>(x))));
  }
  EXPECT_LT(worst, 3e-7);
}

TEST(lane_exp, inverse_error_function_comes_back) {
  // erf(erfinv(y)) = y: within Giles's 3e-7 of x times the slope of erf, and rounding.
  for (int i = -9'999; i <= 9'999; ++i) {
    const float y = static_cast<float>(i) * 1e-4f;
    const auto x = static_cast<double>(lane_erfinv(y));
    const double slope = 2 * std::numbers::inv_sqrtpi * std::exp(-x * x);
    EXPECT_NEAR(std::erf(x), static_cast<double>(y), 1e-7 + 4e-7 * std::abs(x) * slope);
  }
  EXPECT_TRUE(std::isfinite(lane_erfinv(1.0f)));
  EXPECT_TRUE(std::isfinite(lane_erfinv(-1.0f)));
}

}  // namespace
}  // namespace photonproof::inline renderer_lanes
