#include "harness/conclusions/race.h"

#include <gtest/gtest.h>

#include "harness/conclusions/convergence.h"

namespace photonproof::inline harness_conclusions {
namespace {

using Time = RaceRecord::Time;

Convergence curve(const std::string& engine, const std::vector<std::pair<double, double>>& points) {
  Convergence out;
  out.scene = "s";
  out.engine = engine;
  for (const auto& [seconds, relmse] : points) {
    ConvergencePoint point;
    point.seconds.value = seconds;
    point.relmse = Estimate{relmse, {}};
    out.points.push_back(point);
  }
  return out;
}

// `slow` comes down to 0.01 in 8 s; `fast` passes 0.01 halfway (in logarithms) between 1 s and 4 s. Already the
// smallest budget of `late`, at 3 s, is below it. It may have taken 1 s, so it has no place before or behind `fast`.
TEST(Race, is_run_to_the_error_that_most_engines_reach_between_two_budgets) {
  const std::vector<RaceRecord> races = races_of(
      {curve("slow", {{2, 0.04}, {8, 0.01}}), curve("late", {{3, 0.001}}), curve("fast", {{1, 0.02}, {4, 0.005}})});
  ASSERT_EQ(races.size(), 1u);
  EXPECT_EQ(races[0].relmse, 0.01);
  ASSERT_EQ(races[0].times.size(), 3u);
  EXPECT_EQ(races[0].times[0].engine, "fast");
  EXPECT_NEAR(races[0].times[0].seconds, 2, 1e-12);
  EXPECT_EQ(races[0].times[1].engine, "slow");
  EXPECT_NEAR(races[0].times[1].seconds, 8, 1e-12);
  EXPECT_EQ(races[0].times[2], (Time{"late", 3, true, false, true}));
}

// At 0.01 three engines have a time. The weakest one ends at 0.5 and needs more than its 9 s.
TEST(Race, is_not_run_to_the_weakest_engines_error) {
  const std::vector<RaceRecord> races =
      races_of({curve("a", {{1, 0.04}, {4, 0.01}}), curve("b", {{2, 0.04}, {8, 0.01}}),
                curve("c", {{0.5, 0.02}, {1, 0.01}}), curve("weak", {{1, 2}, {9, 0.5}})});
  ASSERT_EQ(races.size(), 1u);
  EXPECT_EQ(races[0].relmse, 0.01);
  EXPECT_EQ(races[0].times, (std::vector<Time>{{"c", 1}, {"a", 4}, {"b", 8}, {"weak", 9, false, true}}));
}

// "At most 1 s" is faster than 5 s whatever it is, and "more than 9 s" is slower; "at most 7 s" is neither.
TEST(Race, bound_has_a_rank_only_where_it_settles_the_order) {
  const auto b = curve("b", {{1, 0.1}, {5, 0.01}}), c = curve("c", {{2, 0.1}, {8, 0.01}});
  const auto times_with = [&](const Convergence& a) { return races_of({a, c, b}).at(0).times; };
  EXPECT_EQ(times_with(curve("a", {{1, 0.001}})), (std::vector<Time>{{"a", 1, true}, {"b", 5}, {"c", 8}}));
  EXPECT_EQ(times_with(curve("a", {{9, 0.2}})), (std::vector<Time>{{"b", 5}, {"c", 8}, {"a", 9, false, true}}));
  EXPECT_EQ(times_with(curve("a", {{7, 0.001}})), (std::vector<Time>{{"b", 5}, {"c", 8}, {"a", 7, true, false, true}}));
  EXPECT_TRUE(races_of({b, curve("a", {{7, 0.001}})}).empty());
}

TEST(Race, of_an_engine_with_two_kinds_of_budget_counts_the_faster) {
  const std::vector<RaceRecord> races = races_of(
      {curve("a", {{1, 0.04}, {4, 0.01}}), curve("a", {{1, 0.02}, {2, 0.01}}), curve("b", {{2, 0.04}, {8, 0.01}})});
  EXPECT_EQ(races.at(0).times, (std::vector<Time>{{"a", 2}, {"b", 8}}));
}

TEST(Race, is_without_engines_whose_error_grows) {
  EXPECT_TRUE(races_of({curve("lucky", {{1, 0.01}, {2, 1}}), curve("other", {{1, 0.1}, {2, 0.01}})}).empty());
}

TEST(Race, is_run_by_an_engine_whose_small_budget_took_longer_by_chance) {
  EXPECT_EQ(races_of({curve("busy", {{3, 0.04}, {2, 0.01}}), curve("other", {{1, 0.1}, {4, 0.01}})}).size(), 1u);
}

TEST(Race, needs_two_engines_with_errors_of_their_own) {
  Convergence rounding = curve("path", {{1, 1e-12}});
  rounding.points[0].undefined[own_error_key] = "it is rounding";
  EXPECT_TRUE(races_of({rounding, curve("other", {{1, 0.1}})}).empty());
}

}  // namespace
}  // namespace photonproof::inline harness_conclusions
