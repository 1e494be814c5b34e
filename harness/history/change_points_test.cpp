// The search for steps against series whose steps are known, and its rate of false alarms against the stated one.
#include "harness/history/change_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "scenes/base/splitmix.h"

namespace photonproof::inline harness_history {
namespace {

/// Independent numbers from a seed.
class Noise {
 public:
  explicit Noise(std::uint64_t seed) : seed_(seed) {}
  double uniform() { return (static_cast<double>(splitmix64(seed_, ++drawn_) >> 11) + 0.5) / 9007199254740992.0; }
  double normal() { return std::sqrt(-2 * std::log(uniform())) * std::cos(2 * 3.14159265358979 * uniform()); }
  double exponential() { return -std::log(uniform()); }

 private:
  std::uint64_t seed_, drawn_ = 0;
};

using Draw = std::function<double(Noise&)>;
double two_percent(Noise& noise) { return 1 + 0.02 * noise.normal(); }
/// Times that interruptions lengthen.
double long_tail(Noise& noise) { return 1 + 0.01 * noise.normal() + 0.02 * noise.exponential(); }

std::vector<double> series(Noise& noise, const std::vector<std::pair<std::size_t, double>>& levels,
                           const Draw& draw = two_percent) {
  std::vector<double> values;
  for (const auto& [count, level] : levels)
    for (std::size_t i = 0; i < count; ++i) values.push_back(level * draw(noise));
  return values;
}

int alarms(const Draw& draw, std::size_t count, int runs, std::uint64_t seed) {
  int found = 0;
  for (int run = 0; run < runs; ++run) {
    Noise noise(seed + static_cast<std::uint64_t>(run) * 1'000'003);
    if (!change_points(series(noise, {{count, 1}}, draw)).empty()) ++found;
  }
  return found;
}

// 4 x 3000 series without a step have 12 alarms in expectation at 0.001; Poisson exceeds 27 with probability 5e-5. At
// 0.01 they have 120, and fewer than 80 with probability 1e-4: the rate is the stated one, not far below it.
TEST(ChangePoints, false_alarms_have_the_stated_rate) {
  int found = 0;
  for (const Draw& draw : {Draw(two_percent), Draw(long_tail)})
    found += alarms(draw, 30, 3000, 1) + alarms(draw, 80, 3000, 2);
  EXPECT_LE(found, 27);
}

TEST(ChangePoints, false_alarms_are_as_many_as_asked_for) {
  int found = 0;
  for (int run = 0; run < 2000; ++run) {
    Noise noise(static_cast<std::uint64_t>(run) * 7919);
    if (!change_points(series(noise, {{40, 1}}), {.significance = 0.05, .permutations = 19}).empty()) ++found;
  }
  // 100 in expectation, with a standard deviation of 9.7. Of 19 permutations none may exceed.
  EXPECT_GE(found, 60);
  EXPECT_LE(found, 140);
}

double power(std::size_t before, std::size_t after, double size) {
  int found = 0;
  constexpr int runs = 200;
  for (int run = 0; run < runs; ++run) {
    Noise noise(static_cast<std::uint64_t>(run) * 104'729 + 5);
    const std::vector<std::size_t> steps = change_points(series(noise, {{before, 1}, {after, 1 + size}}));
    if (std::ranges::any_of(steps, [&](std::size_t at) { return at + 2 >= before && at <= before + 2; })) ++found;
  }
  return static_cast<double>(found) / runs;
}

// docs/verbs/history.md prints these; the standard deviation of a rate is at most 0.035.
TEST(ChangePoints, steps_are_found_as_often_as_documented) {
  EXPECT_GE(power(30, 4, 0.10), 0.9);
  EXPECT_GE(power(30, 8, 0.05), 0.68);
  EXPECT_GE(power(60, 8, 0.05), 0.82);
  EXPECT_GE(power(30, 12, 0.05), 0.85);
}

// Annual flow of the Nile at Aswan, 1871 to 1970 (Cobb 1978, "The problem of the Nile", Biometrika 65). The level falls
// after 1898, the 28th year, by all published methods.
TEST(ChangePoints, level_of_the_nile_falls_after_1898) {
  const std::vector<double> nile{
      1120, 1160, 963,  1210, 1160, 1160, 813,  1230, 1370, 1140, 995,  935,  1110, 994, 1020, 960,  1180,
      799,  958,  1140, 1100, 1210, 1150, 1250, 1260, 1220, 1030, 1100, 774,  840,  874, 694,  940,  833,
      701,  916,  692,  1020, 1050, 969,  831,  726,  456,  824,  702,  1120, 1100, 832, 764,  821,  768,
      845,  864,  862,  698,  845,  744,  796,  1040, 759,  781,  865,  845,  944,  984, 897,  822,  1010,
      771,  676,  649,  846,  812,  742,  801,  1040, 860,  874,  848,  890,  744,  749, 838,  1050, 918,
      986,  797,  923,  975,  815,  1020, 906,  901,  1170, 912,  746,  919,  718,  714, 740};
  ASSERT_EQ(nile.size(), 100u);
  EXPECT_EQ(change_points(nile), std::vector<std::size_t>{28});
}

TEST(ChangePoints, level_that_returns_has_two_steps) {
  Noise noise(3);
  EXPECT_EQ(change_points(series(noise, {{40, 1}, {12, 1.15}, {40, 1}})), (std::vector<std::size_t>{40, 52}));
}

TEST(ChangePoints, several_levels_are_told_apart) {
  Noise noise(4);
  EXPECT_EQ(change_points(series(noise, {{30, 1}, {30, 2}, {30, 4}, {30, 0.5}})),
            (std::vector<std::size_t>{30, 60, 90}));
}

TEST(ChangePoints, single_outliers_are_no_step) {
  Noise noise(5);
  std::vector<double> values = series(noise, {{40, 1}});
  values[7] = 30;
  values[8] = 1e300;
  values[39] = 50;
  EXPECT_EQ(change_points(values), std::vector<std::size_t>{});
}

TEST(ChangePoints, step_is_found_beside_outliers) {
  Noise noise(8);
  std::vector<double> values = series(noise, {{40, 1}, {12, 1.1}});
  values[7] = 30;
  values[20] = 500;
  values[45] = 1e6;
  EXPECT_EQ(change_points(values), std::vector<std::size_t>{40});
}

TEST(ChangePoints, short_level_among_many_values_is_found) {
  int found = 0;
  for (std::uint64_t run = 0; run < 40; ++run) {
    Noise noise(run * 6007 + 1);
    if (change_points(series(noise, {{100, 1}, {9, 1.05}, {100, 1}})).size() == 2) ++found;
  }
  EXPECT_GE(found, 24);
}

TEST(ChangePoints, ten_thousand_values_are_searched_and_the_step_is_placed) {
  Noise noise(6);
  const std::vector<std::size_t> steps = change_points(series(noise, {{6007, 1}, {3993, 1.05}}));
  ASSERT_EQ(steps.size(), 1u);
  EXPECT_NEAR(static_cast<double>(steps[0]), 6007, 3);
}

TEST(ChangePoints, few_or_equal_values_have_none) {
  EXPECT_TRUE(change_points({}).empty());
  EXPECT_TRUE(change_points(std::vector<double>{1, 1, 1, 9, 9}).empty());
  EXPECT_TRUE(change_points(std::vector<double>(50, 3)).empty());
}

TEST(ChangePoints, values_that_repeat_are_told_by_their_changes) {
  const std::vector<double> values{2, 2, 2, 3, 3, 3, 3};
  EXPECT_TRUE(repeats_exactly(values));
  EXPECT_EQ(exact_changes(values), std::vector<std::size_t>{3});
  Noise noise(7);
  EXPECT_FALSE(repeats_exactly(series(noise, {{20, 1}})));
  EXPECT_FALSE(repeats_exactly(std::vector<double>{1}));
}

}  // namespace
}  // namespace photonproof::inline harness_history
