// The drift of series whose growth is known: how often the verdict is right.

#include "harness/stress/soak/drift.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace photonproof::inline harness_stress_soak {
namespace {

using enum DriftVerdict;

std::vector<double> noisy(int count, double growth, double noise, unsigned seed, double memory = 0) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::vector<double> values;
  double kept = 0;
  for (int i = 0; i < count; ++i) {
    kept = memory * kept + normal(random);
    values.push_back(1000 + growth * i + noise * kept);
  }
  return values;
}

int called(DriftVerdict verdict, int count, double growth, double noise, double bound, double memory = 0) {
  int times = 0;
  for (unsigned seed = 1; seed <= 1000; ++seed)
    times += drift_of(noisy(count, growth, noise, seed, memory), bound).verdict == verdict ? 1 : 0;
  return times;
}

TEST(Drift, is_the_slope_of_a_line_through_the_values) {
  // Sum of (i - 2)(y - 3) over i = 0..4 of y = 1, 3, 2, 5, 4 is 4 + 0 + 0 + 2 + 2 = 8; of (i - 2)^2 it is 10.
  const Drift drift = drift_of(std::vector<double>{1, 3, 2, 5, 4}, 0);
  EXPECT_DOUBLE_EQ(drift.slope, 0.8);
  EXPECT_DOUBLE_EQ(drift.mean_value, 3);
  EXPECT_LT(drift.interval.low, 0.8);
  EXPECT_GT(drift.interval.high, 0.8);
}

TEST(Drift, of_equal_values_is_flat_within_any_bound_and_of_a_line_grows) {
  EXPECT_EQ(drift_of(std::vector<double>(8, 3.0), 0).verdict, flat);
  EXPECT_EQ(drift_of(std::vector<double>{1, 2, 3, 4, 5, 6}, 0.5).verdict, grows);
  EXPECT_EQ(drift_of(std::vector<double>{1, 2, 3, 4, 5, 6}, 1.5).verdict, flat);
  EXPECT_EQ(drift_of(std::vector<double>{6, 5, 4, 3, 2, 1}, 0).verdict, flat);
}

TEST(Drift, of_few_values_is_unclear) {
  EXPECT_EQ(drift_of(std::vector<double>{1, 2, 3, 4}, 10).verdict, unclear);
  EXPECT_EQ(drift_of({}, 10).verdict, unclear);
}

// The slope's standard error is 1 / sqrt(25 (25^2 - 1) / 12) = 0.028: a growth of 0.2 is 7 of them, and so is a bound
// of 0.2.
TEST(Drift, that_is_seen_is_called_and_none_is_not) {
  EXPECT_GE(called(grows, 25, 0.2, 1, 0.01), 990);
  EXPECT_LE(called(grows, 25, 0, 1, 0.01), 3);
  EXPECT_GE(called(flat, 25, 0, 1, 0.2), 990);
  EXPECT_LE(called(flat, 25, 0.2, 1, 0.2), 3);
}

TEST(Drift, that_noise_hides_is_unclear) { EXPECT_GE(called(unclear, 25, 0, 1, 0.001), 400); }

// Values with correlation 0.7 wander: taken as independent, a tenth of them would be called growing.
TEST(Drift, is_not_called_of_values_that_only_wander) { EXPECT_LE(called(grows, 40, 0, 1, 0.0001, 0.7), 20); }

}  // namespace
}  // namespace photonproof::inline harness_stress_soak
