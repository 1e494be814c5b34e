#include "harness/conclusions/race.h"

#include <gtest/gtest.h>

#include "harness/conclusions/convergence.h"

namespace photonproof {
namespace {

Convergence curve(const std::string& engine, const std::vector<std::pair<double, double>>& points) {
  Convergence out;
  out.scene = "s";
  out.engine = engine;
  for (const auto& [seconds, relmse] : points) {
    CurvePoint point;
    point.seconds.value = seconds;
    point.relmse = Estimate{relmse, {}};
    out.points.push_back(point);
  }
  return out;
}

// `slow` comes down to 0.01 in 8 s at best; `fast` passes 0.01 halfway (in logarithms) between 1 s and 4 s; `late` is
// below it with its smallest budget already, after 3 s.
TEST(Race, is_run_to_the_least_error_that_all_engines_reach) {
  const std::vector<RaceRecord> races = races_of(
      {curve("slow", {{2, 0.04}, {8, 0.01}}), curve("fast", {{1, 0.02}, {4, 0.005}}), curve("late", {{3, 0.001}})});
  ASSERT_EQ(races.size(), 1u);
  EXPECT_EQ(races[0].relmse, 0.01);
  ASSERT_EQ(races[0].times.size(), 3u);
  EXPECT_EQ(races[0].times[0].engine, "fast");
  EXPECT_NEAR(races[0].times[0].seconds, 2, 1e-12);
  EXPECT_FALSE(races[0].times[0].at_most);
  EXPECT_EQ(races[0].times[1], (RaceRecord::Time{"late", 3, true}));
  EXPECT_EQ(races[0].times[2].engine, "slow");
  EXPECT_NEAR(races[0].times[2].seconds, 8, 1e-12);
}

TEST(Race, is_without_engines_whose_error_grows) {
  EXPECT_TRUE(races_of({curve("lucky", {{1, 0.01}, {2, 1}}), curve("other", {{1, 0.1}})}).empty());
}

TEST(Race, is_run_by_an_engine_whose_small_budget_took_longer_by_chance) {
  EXPECT_EQ(races_of({curve("busy", {{3, 0.04}, {2, 0.01}}), curve("other", {{1, 0.1}})}).size(), 1u);
}

TEST(Race, needs_two_engines_with_errors_of_their_own) {
  Convergence rounding = curve("path", {{1, 1e-12}});
  rounding.points[0].undefined[own_error_key] = "it is rounding";
  EXPECT_TRUE(races_of({rounding, curve("other", {{1, 0.1}})}).empty());
}

}  // namespace
}  // namespace photonproof
