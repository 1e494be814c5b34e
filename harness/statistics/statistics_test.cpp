#include "harness/statistics/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace photonproof {
namespace {

TEST(Statistics, median_is_the_middle_value_or_the_mean_of_the_two) {
  EXPECT_EQ(median_of(std::vector<double>{7}), 7);
  EXPECT_EQ(median_of(std::vector<double>{9, 1, 4}), 4);
  EXPECT_EQ(median_of(std::vector<double>{9, 1, 4, 6}), 5);
  EXPECT_EQ(median_of(std::vector<double>{2, 2, 1, 9}), 2);
}

// The median of five resampled values is the least one when three draws or more hit it:
// sum over k = 3, 4, 5 of C(5,k) 0.2^k 0.8^(5-k) = 0.058 > 0.025, so each end is the extreme value.
TEST(Statistics, interval_of_the_median_of_five_runs_from_the_least_to_the_largest) {
  const Estimate estimate = estimated_median(std::vector<double>{3, 1, 2, 5, 4});
  EXPECT_EQ(estimate.value, 3);
  EXPECT_EQ(estimate.interval, (Interval{1, 5}));
  EXPECT_FALSE(estimated_median(std::vector<double>{3, 1, 2, 5}).interval);
}

// Of n normal values the mean's interval is +-1.96 sd / sqrt(n) up to the bootstrap's own noise.
TEST(Statistics, interval_of_a_normal_mean_is_as_wide_as_theory_says) {
  std::mt19937_64 generator(1);
  std::normal_distribution<double> normal(10, 2);
  std::vector<double> values(400);
  for (double& value : values) value = normal(generator);
  double squares = 0;
  for (const double value : values) squares += std::pow(value - mean_of(values), 2);
  const double expected = 1.96 * std::sqrt(squares / 399) / std::sqrt(400.0);
  const Estimate estimate = estimated_mean(values);
  EXPECT_NEAR(estimate.interval->high - estimate.value, expected, 0.08 * expected);
  EXPECT_NEAR(estimate.value - estimate.interval->low, expected, 0.08 * expected);
}

TEST(Statistics, same_values_give_the_same_interval_again) {
  const std::vector<double> values{1, 5, 2, 8, 3, 3, 9};
  EXPECT_EQ(estimated_mean(values), estimated_mean(values));
  EXPECT_EQ(estimated_median(values), estimated_median(values));
}

TEST(Statistics, resampling_draws_from_its_seed) {
  const std::vector<double> values{1, 5, 2, 8, 3, 3, 9};
  const Interval first = *estimated_mean(values, {0.95, 500, 1}).interval;
  EXPECT_EQ(first, *estimated_mean(values, {0.95, 500, 1}).interval);
  EXPECT_NE(first, *estimated_mean(values, {0.95, 500, 2}).interval);
}

TEST(Statistics, equal_values_have_an_interval_of_no_width) {
  const std::vector<double> values(6, 4.25);
  EXPECT_EQ(estimated_mean(values).interval, (Interval{4.25, 4.25}));
  EXPECT_EQ(estimated_median(values).interval, (Interval{4.25, 4.25}));
}

// Nominal 95 %; over 500 experiments the binomial's standard error is 1 %, and bounds are 3 of them. Intervals of the
// mean of skewed values fall short by about a percent at n = 100 (Hesterberg 2015, "What teachers should know about
// the bootstrap", figure 10).
TEST(Statistics, intervals_cover_the_truth_about_as_often_as_they_say) {
  std::mt19937_64 generator(7);
  std::exponential_distribution<double> exponential(1);
  int mean_held = 0, median_held = 0;
  constexpr int experiments = 500;
  for (int e = 0; e < experiments; ++e) {
    std::vector<double> values(100);
    for (double& value : values) value = exponential(generator);
    const BootstrapOptions options{0.95, 400, static_cast<std::uint64_t>(e)};
    const Interval mean = *estimated_mean(values, options).interval;
    const Interval median = *estimated_median(values, options).interval;
    mean_held += mean.low <= 1 && 1 <= mean.high;
    median_held += median.low <= std::log(2.0) && std::log(2.0) <= median.high;
  }
  EXPECT_GT(mean_held, 500 * (0.94 - 0.03));
  EXPECT_LT(mean_held, 500 * (0.95 + 0.03));
  EXPECT_GT(median_held, 500 * (0.95 - 0.03));
  EXPECT_LT(median_held, 500 * (0.95 + 0.03));
}

// BCa of skewed data reaches further up than the percentile interval does.
TEST(Statistics, bca_follows_the_skew_of_the_data) {
  const std::vector<double> values{1, 1, 1, 2, 2, 3, 4, 30};
  const IndexStatistic mean = [&](std::span<const std::size_t> indices) {
    double sum = 0;
    for (const std::size_t i : indices) sum += values[i];
    return sum / static_cast<double>(indices.size());
  };
  const Interval percentile = bootstrap_percentile(values.size(), mean), bca = bootstrap_bca(values.size(), mean);
  EXPECT_GT(bca.high, percentile.high);
  EXPECT_GT(bca.low, percentile.low);
}

// x = 1..5, y = 2, 4, 5, 4, 5 (the standard textbook example): slope 0.6, intercept 2.2, sum of squared residuals 2.4,
// sum (x - 3)^2 = 10, so the slope's standard error is sqrt(2.4 / 3 / 10) = 0.28284; t(0.975; 3) = 3.18245.
TEST(Statistics, least_squares_slope_and_its_t_interval_are_the_textbook_ones) {
  const LineFit fit = *fit_line(std::vector<double>{1, 2, 3, 4, 5}, std::vector<double>{2, 4, 5, 4, 5});
  EXPECT_NEAR(fit.slope, 0.6, 1e-12);
  EXPECT_NEAR(fit.intercept, 2.2, 1e-12);
  EXPECT_NEAR(fit.slope_interval->low, 0.6 - 3.18245 * 0.28284, 1e-4);
  EXPECT_NEAR(fit.slope_interval->high, 0.6 + 3.18245 * 0.28284, 1e-4);
}

TEST(Statistics, line_needs_two_places_and_its_interval_three_points) {
  EXPECT_FALSE(fit_line(std::vector<double>{1}, std::vector<double>{2}));
  EXPECT_FALSE(fit_line(std::vector<double>{1, 1}, std::vector<double>{2, 3}));
  EXPECT_FALSE(fit_line(std::vector<double>{1, 2}, std::vector<double>{2, 3})->slope_interval);
}

// median 10.05, deviations' median 0.1: 14 scores 0.6745 * 3.95 / 0.1 = 26.6, 10.2 scores 1.0.
TEST(Statistics, outliers_are_told_by_the_median_deviation) {
  EXPECT_EQ(outliers_of(std::vector<double>{10, 10.1, 9.9, 14, 10.2, 9.95, 10.15, 10}), std::vector<std::size_t>{3});
  EXPECT_TRUE(outliers_of(std::vector<double>{1, 1, 1, 1, 1, 100}).empty());
  EXPECT_TRUE(outliers_of(std::vector<double>{1, 2, 3, 100}).empty());
  // Median 0 and median deviation 1: the limit is 3.5/0.6745 = 5.189.
  EXPECT_TRUE(outliers_of(std::vector<double>{-1, -1, -1, 0, 1, 1, 5.1}).empty());
  EXPECT_EQ(outliers_of(std::vector<double>{-1, -1, -1, 0, 1, 1, 5.3}), std::vector<std::size_t>{6});
}

}  // namespace
}  // namespace photonproof
