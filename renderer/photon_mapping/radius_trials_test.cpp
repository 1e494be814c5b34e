// The best of tried radii: that of the formulas for smooth light, and the least error found for any number of photons.

#include "renderer/photon_mapping/radius_trials.h"

#include <gtest/gtest.h>

#include <cmath>

namespace photonproof::inline renderer_photon_mapping {
namespace {

constexpr double pilot = 20000, step = 1.1;

/// Trials of L(r) with the variance 1 / r^2 and the squared bias r^4, in fine steps.
RadiusTrials smooth_light() {
  RadiusTrials trials(pilot);
  for (double r = 0.1; r < 10; r *= step) trials.add(r, 1 / (r * r), std::pow(r, 4), 0);
  return trials;
}

TEST(radius_trials, find_the_radius_where_variance_is_twice_the_squared_bias) {
  // The derivative of n/r^2 + r^4 is 0 at r^6 = n/2. Errors up to 1.2 times that count as near: with x = (r/r0)^2 and
  // 2/x + x^2 = 3.6 from x = .66 on, or from .81 of the radius. There the error by theory, 3/2 n/r^2, is 1.52 times the
  // least.
  for (const double share : {0.01, 0.1, 1.0}) {
    const double n = 1 / share, best = std::pow(n / 2, 1.0 / 6), least = 1.5 * n / (best * best);
    EXPECT_GT(smooth_light().best(share * pilot), 0.80 * best) << share;
    EXPECT_LT(smooth_light().best(share * pilot), 0.81 * step * best) << share;
    EXPECT_GT(smooth_light().error(share * pilot), least) << share;
    EXPECT_LT(smooth_light().error(share * pilot), 1.55 * least) << share;
  }
}

TEST(radius_trials, follow_the_power_law_beyond_the_pilot) {
  const RadiusTrials trials = smooth_light();
  EXPECT_NEAR(trials.best(64 * pilot), trials.best(pilot) / 2, 1e-12);
  EXPECT_NEAR(trials.error(64 * pilot), trials.error(pilot) / 16, 1e-12);
}

TEST(radius_trials, take_the_narrowest_where_bias_rules_and_the_widest_of_even_light) {
  RadiusTrials edges(pilot), even(pilot);
  for (double r = 1; r < 5; r *= step) {
    edges.add(r, 1e-9 / (r * r), r, 0);
    even.add(r, 1 / (r * r), 0, 0);
  }
  EXPECT_EQ(edges.best(pilot), 1);
  EXPECT_NEAR(edges.error(pilot), 1, 1e-6);
  EXPECT_GT(even.best(pilot), 5 / (step * step * step));
}

TEST(radius_trials, heed_doubt_in_the_choice_but_not_in_the_error) {
  RadiusTrials trials(pilot);
  trials.add(1, 0.4, 0, 0);
  trials.add(2, 0.1, 0, 1);
  EXPECT_EQ(trials.best(pilot), 1);
  EXPECT_NEAR(trials.error(pilot), 0.6, 1e-12);
}

}  // namespace
}  // namespace photonproof::inline renderer_photon_mapping
