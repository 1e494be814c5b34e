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

/// Trials of L(r) with the variance 1 / r^2 and the squared bias r^p, whose error is a tenth.
RadiusTrials light_of_exponent(double p, double least) {
  RadiusTrials trials(pilot, least);
  for (double r = 0.1; r < 10; r *= std::sqrt(2.0)) trials.add(r, 1 / (r * r), std::pow(r, p), 0.1 * std::pow(r, p));
  return trials;
}

TEST(radius_trials, measure_the_exponent_of_the_bias_within_its_limits) {
  for (const double p : {1.0, 1.7, 2.5, 4.0}) EXPECT_NEAR(light_of_exponent(p, edge_exponent).exponent(), p, 1e-9) << p;
  EXPECT_EQ(light_of_exponent(0.5, edge_exponent).exponent(), edge_exponent);
  EXPECT_EQ(light_of_exponent(6, edge_exponent).exponent(), smooth_exponent);
  EXPECT_EQ(light_of_exponent(1, smooth_exponent).exponent(), smooth_exponent);
  EXPECT_EQ(RadiusTrials(pilot).exponent(), smooth_exponent) << "no trials";
}

TEST(radius_trials, measure_the_exponent_at_the_narrowest_plain_biases_alone) {
  RadiusTrials trials(pilot);
  const double bias[] = {1e-6, 1e-6, 2, 2 * std::sqrt(2.0), 4, 400};  // of edges between noise and smooth light
  for (int i = 0; i < 6; ++i) trials.add(std::pow(2, i / 2.0), 1, bias[i], 0.1);
  EXPECT_NEAR(trials.exponent(), 1, 1e-9);
}

TEST(radius_trials, expect_errors_of_edges_beyond_the_pilot_and_shrink_with_care) {
  // V = c/(n r^2) and B^2 = b r^p: the error is in proportion to n^(-p/(p+2)). The radius follows smooth light.
  const RadiusTrials edges = light_of_exponent(1, edge_exponent);
  EXPECT_NEAR(edges.best(64 * pilot), edges.best(pilot) / 2, 1e-9);
  EXPECT_NEAR(edges.error(64 * pilot), edges.error(pilot) / 4, 1e-9);
  EXPECT_NEAR(edges.error(pilot), 3 / (edges.best(pilot) * edges.best(pilot)), 1e-9) << "V and a squared bias of 2V";
}

// The limit of the exponent is for radii. Errors fall as the trials show, or as n^(-1/2) where they show no bias.
TEST(radius_trials, expect_errors_by_the_exponent_that_is_seen) {
  const RadiusTrials edges = light_of_exponent(1, smooth_exponent);
  EXPECT_NEAR(edges.error(64 * pilot), edges.error(pilot) / 4, 1e-9);
  RadiusTrials unseen(pilot, smooth_exponent);
  for (double r = 0.1; r < 10; r *= step) unseen.add(r, 1 / (r * r), 0, std::pow(r, 4));
  EXPECT_NEAR(unseen.error(64 * pilot), unseen.error(pilot) / 8, 1e-9);
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
  EXPECT_NEAR(trials.error(pilot), 0.8, 1e-12) << "as much bias as variance, as with the exponent 2";
}

}  // namespace
}  // namespace photonproof::inline renderer_photon_mapping
