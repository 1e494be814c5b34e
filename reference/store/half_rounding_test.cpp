#include "reference/store/half_rounding.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace photonproof::inline reference_store {
namespace {

Rendering uniform(int side, float value, float variance) {
  Rendering r{Image(side, side), Image(side, side), {}};
  std::fill(r.mean.rgb.begin(), r.mean.rgb.end(), value);
  std::fill(r.variance->rgb.begin(), r.variance->rgb.end(), variance);
  return r;
}

TEST(HalfRounding, neighbours_are_those_of_the_format) {
  EXPECT_EQ(half_below(1.0f), 1.0f);
  EXPECT_EQ(half_above(1.0f), 1.0f);
  // From 1 to 2 halves are 2^-10 apart.
  EXPECT_EQ(half_below(1.0005f), 1.0f);
  EXPECT_EQ(half_above(1.0005f), 1.0f + 0x1p-10f);
  EXPECT_EQ(half_below(-1.0005f), -1.0f - 0x1p-10f);
  EXPECT_EQ(half_above(1.9999f), 2.0f);
  // Below 2^-14 they are 2^-24 apart.
  EXPECT_EQ(half_below(0x1.8p-24f), 0x1p-24f);
  EXPECT_EQ(half_above(0x1.8p-24f), 0x1p-23f);
  EXPECT_EQ(half_above(1e-12f), 0x1p-24f);
  EXPECT_EQ(half_below(0.0f), 0.0f);
  EXPECT_EQ(half_above(largest_half), largest_half);
}

TEST(HalfRounding, value_that_is_a_half_stays_and_costs_no_variance) {
  const Rendering before = uniform(4, 0.75f, 0x1p-20f);
  const Rendering rounded = rounded_to_halves(before);
  EXPECT_EQ(rounded.mean.rgb, before.mean.rgb);
  EXPECT_EQ(rounded.variance->rgb, before.variance->rgb);
}

TEST(HalfRounding, even_surface_keeps_its_mean_and_gets_the_variance_of_the_draw) {
  // 3/8 of the way between 2 and 2 + 2^-9: every value is one of the two, their mean is x, their variance
  // (3/8)(5/8) 2^-18. The nearest half would be 2 everywhere: a bias of 3/8 2^-9.
  const float x = 2 + 0.375f * 0x1p-9f;
  constexpr int side = 128;
  const Rendering rounded = rounded_to_halves(uniform(side, x, 0));
  const double variance = 0.375 * 0.625 * 0x1p-18, n = 3.0 * side * side;
  double sum = 0;
  for (const float v : rounded.mean.rgb) {
    ASSERT_TRUE(v == 2 || v == 2 + 0x1p-9f);
    sum += v - double{x};
  }
  EXPECT_LT(std::abs(sum / n), 4 * std::sqrt(variance / n));
  for (const float v : rounded.variance->rgb) EXPECT_NEAR(v, variance, variance * 0x1p-11);
}

TEST(HalfRounding, variance_below_the_least_half_survives) {
  // 1e-12 is below 2^-24, the least half that is not 0; 11 significant bits of it are kept.
  const Rendering rounded = rounded_to_halves(uniform(2, 1, 1e-12f));
  EXPECT_NEAR(rounded.variance->rgb[0], 1e-12, 1e-12 * 0x1p-11);
}

TEST(half_rounding, rounded_values_are_as_uncertain_as_rounding_can_make_them) {
  Rendering rendering{Image(2, 1), Image(2, 1), {}};
  std::fill(rendering.mean.rgb.begin(), rendering.mean.rgb.end(), 2.0f);
  rendering.variance->rgb[5] = 0.25f;
  widen_to_half_rounding(rendering);
  EXPECT_FLOAT_EQ(rendering.variance->rgb[0], 0x1p-20f);  // half floats above 2 are 2^-9 apart: at most (2^-10)^2
  EXPECT_FLOAT_EQ(rendering.variance->rgb[5], 0.25f);
}

}  // namespace
}  // namespace photonproof::inline reference_store
