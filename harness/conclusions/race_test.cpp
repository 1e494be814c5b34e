#include "harness/conclusions/race.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "harness/conclusions/error_curve.h"
#include "harness/statistics/statistics.h"

namespace photonproof::inline harness_conclusions {
namespace {

using Time = RaceRecord::Time;
using Points = std::vector<std::pair<double, double>>;

Convergence curve(const std::string& engine, const Points& points) {
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

// Errors known to a factor of `spread`, times exactly.
Convergence known_to(double spread, Convergence curve) {
  for (ConvergencePoint& point : curve.points) {
    const double seconds = point.seconds.value, relmse = point.relmse->value;
    point.seconds.interval = Interval{seconds, seconds};
    point.relmse->interval = Interval{relmse / spread, relmse * spread};
  }
  return curve;
}

std::vector<std::string> order_of(const RaceRecord& race) {
  std::vector<std::string> engines;
  for (const Time& time : race.times) engines.push_back(time.engine + (time.unranked ? "?" : ""));
  return engines;
}

// relmse = 0.01 / s and 0.1 / s: at every error ten times the time, at every time ten times the error. The curves'
// errors are known to 10 %, so the ratio is known to exp(sqrt(2) ln 1.1).
TEST(Race, ratio_and_its_interval_are_those_of_two_parallel_curves) {
  const std::vector<RaceRecord> races = races_of({known_to(1.1, curve("slow", {{1, 0.1}, {100, 0.001}})),
                                                  known_to(1.1, curve("fast", {{1, 0.01}, {100, 0.0001}}))});
  ASSERT_EQ(races.size(), 1u);
  const RaceRecord& race = races[0];
  EXPECT_FALSE(race.is_target);
  EXPECT_EQ(order_of(race), (std::vector<std::string>{"fast", "slow"}));
  EXPECT_FALSE(race.times[0].ratio);
  const Estimate& ratio = *race.times[1].ratio;
  EXPECT_NEAR(ratio.value, 10, 1e-9);
  const double half = std::sqrt(2) * std::log(1.1);
  EXPECT_NEAR(std::log(ratio.interval->low), std::log(10) - half, 1e-9);
  EXPECT_NEAR(std::log(ratio.interval->high), std::log(10) + half, 1e-9);
  EXPECT_GT(ratio.interval->low, 1);
  EXPECT_EQ(race.seconds, 100) << "the largest round time within both";
  ASSERT_EQ(race.errors.size(), 2u);
  EXPECT_EQ(race.errors[0].engine, "fast");
  EXPECT_NEAR(race.errors[0].relmse.value, 0.0001, 1e-12);
  EXPECT_NEAR(race.errors[1].ratio->value, 10, 1e-9);
  EXPECT_NEAR(std::log(race.errors[1].ratio->interval->low), std::log(10) - half, 1e-9);
}

// 0.001 is the weaker engine's own last error.
TEST(Race, is_not_run_to_an_engines_own_last_error) {
  const auto races = races_of({known_to(1.1, curve("slow", {{1, 0.1}, {100, 0.001}})),
                               known_to(1.1, curve("fast", {{1, 0.01}, {100, 0.0001}}))});
  EXPECT_EQ(races.at(0).relmse, 0.002);
}

// Two engines, one exactly ten times as fast at equal error. Errors of five seeds vary by 10 %, and three in ten have a
// firefly that adds an exponential error of mean 2. Times vary by 3 %. At least 95 % of the intervals hold 10.
TEST(Race, intervals_of_the_ratio_hold_the_truth_in_spite_of_fireflies) {
  constexpr int repetitions = 1000;
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  std::exponential_distribution<double> firefly(0.5);
  std::uniform_real_distribution<double> uniform;
  const auto measured = [&](const std::string& engine, double relmse_at_one_second) {
    Convergence out = curve(engine, {{1, 1}, {4, 1}, {16, 1}, {64, 1}});
    for (ConvergencePoint& point : out.points) {
      const double truth = point.seconds.value;
      std::vector<double> errors, seconds;
      for (int seed = 0; seed < 5; ++seed) {
        const double bright = uniform(random) < 0.3 ? firefly(random) : 0;
        errors.push_back(relmse_at_one_second / truth * (std::exp(0.1 * normal(random)) + bright));
        seconds.push_back(truth * std::exp(0.03 * normal(random)));
      }
      point.seconds = estimated_time(seconds);
      const Estimate error = estimated_mean(errors);
      point.relmse = Estimate{error.value, {}};
      point.spread_of_seeds = error.interval;
    }
    return out;
  };
  int with_interval = 0, held = 0;
  for (int i = 0; i < repetitions; ++i) {
    const auto races = races_of({measured("slow", 0.1), measured("fast", 0.01)});
    const auto& ratio = races.at(0).times.at(1).ratio;
    if (!ratio || !ratio->interval) continue;
    ++with_interval;
    held += ratio->interval->low <= 10 && 10 <= ratio->interval->high;
  }
  EXPECT_GE(with_interval, 0.95 * repetitions);
  EXPECT_GE(held, 0.95 * with_interval) << held << " of " << with_interval;
}

TEST(Race, is_run_to_the_targets_of_the_suite) {
  Convergence slow = curve("slow", {{1, 0.1}, {100, 0.001}}), fast = curve("fast", {{1, 0.01}, {100, 0.0001}});
  slow.targets = fast.targets = {{0.003}, {0.00001}};
  const auto races = races_of({slow, fast});
  ASSERT_EQ(races.size(), 2u);
  EXPECT_EQ(races[0].relmse, 0.003);
  EXPECT_TRUE(races[0].is_target);
  EXPECT_NEAR(races[0].times.at(1).ratio->value, 10, 1e-9);
  EXPECT_TRUE(races[1].times.empty());
  EXPECT_EQ(races[1].undecided, "no two engines' budgets show their order at relMSE 1e-05");
}

// Between 0.02 and 0.01 three engines have a time. The weakest one ends at 0.5 and needs more than its 9 s.
TEST(Race, bound_gives_the_least_ratio) {
  const std::vector<RaceRecord> races =
      races_of({curve("a", {{1, 0.04}, {4, 0.01}}), curve("b", {{2, 0.04}, {8, 0.01}}),
                curve("c", {{0.5, 0.02}, {1, 0.01}}), curve("weak", {{1, 2}, {9, 0.5}})});
  ASSERT_EQ(races.size(), 1u);
  EXPECT_EQ(races[0].relmse, 0.01);
  EXPECT_EQ(order_of(races[0]), (std::vector<std::string>{"c", "a", "b", "weak"}));
  EXPECT_EQ(races[0].times[2].ratio->value, 8);
  EXPECT_FALSE(races[0].times[2].at_least);
  EXPECT_EQ(races[0].times[3].ratio->value, 9);
  EXPECT_TRUE(races[0].times[3].at_least);
  EXPECT_TRUE(races[0].times[3].more_than);
}

// The largest budget's error of 0.012 may be 0.009 in truth, below the 0.01: so "more than 50 s" says nothing.
TEST(Race, bound_within_the_noise_of_its_error_has_no_rank) {
  Convergence fast = known_to(1.01, curve("fast", {{1, 0.1}, {10, 0.01}, {20, 0.005}}));
  for (const auto& [spread, known] : {std::pair{1.1, true}, std::pair{1.4, false}}) {
    Convergence slow = known_to(spread, curve("slow", {{5, 0.12}, {50, 0.012}}));
    fast.targets = slow.targets = {{0.01}};
    const RaceRecord race = races_of({fast, slow}).at(0);
    EXPECT_EQ(race.undecided.empty(), known) << spread;
    if (!known) continue;
    EXPECT_NEAR(race.times.at(1).ratio->value, 50 / 10.1, 0.02);
  }
}

// "At most 1 s" is faster than 5 s whatever it is, and "more than 9 s" is slower; "at most 7 s" is neither.
TEST(Race, bound_has_a_rank_only_where_it_settles_the_order) {
  Convergence b = curve("b", {{1, 0.1}, {5, 0.01}}), c = curve("c", {{2, 0.1}, {8, 0.01}});
  b.targets = {{0.01}};
  const auto order_with = [&](const Convergence& a) { return order_of(races_of({a, c, b}).at(0)); };
  using Order = std::vector<std::string>;
  EXPECT_EQ(order_with(curve("a", {{1, 0.001}})), (Order{"a", "b", "c"}));
  EXPECT_EQ(order_with(curve("a", {{9, 0.2}})), (Order{"b", "c", "a"}));
  EXPECT_EQ(order_with(curve("a", {{7, 0.001}})), (Order{"b", "c", "a?"}));
}

// Paths end at 0.13 after 0.6 s. The photon mapper has 0.002 at 0.15 s. The third engine's one image took 17 s.
TEST(Race, open_bound_of_a_third_engine_hides_no_order) {
  const auto races = races_of({curve("path", {{0.04, 0.4}, {0.6, 0.13}}),
                               curve("photonmapper", {{0.08, 0.005}, {0.2, 0.0013}}), curve("povray", {{17, 0.0003}})});
  EXPECT_EQ(races.at(0).relmse, 0.002);
  EXPECT_EQ(order_of(races[0]), (std::vector<std::string>{"photonmapper", "path", "povray?"}));
  EXPECT_NEAR(races[0].times[1].ratio->value, 0.6 / races[0].times[0].seconds, 1e-9);
  EXPECT_TRUE(races[0].times[1].at_least);
}

// The engine of 0.01 s may need nothing, but its error may also be above 0.02. The one of 0.03 s surely has that error.
TEST(Race, among_bounds_alone_the_one_leads_that_settles_an_order) {
  Convergence sure = known_to(1.01, curve("sure", {{0.03, 0.01}})), slow = known_to(1.01, curve("slow", {{1, 0.1}}));
  sure.targets = {{0.02}};
  const auto races = races_of({known_to(3, curve("unsure", {{0.01, 0.01}})), sure, slow});
  EXPECT_EQ(order_of(races.at(0)), (std::vector<std::string>{"sure", "slow", "unsure?"}));
}

// In a furnace the first engine has rounding alone, the other one a bias of 0.3 % or 0.1 %.
TEST(Race, is_not_run_to_errors_that_nobody_sees) {
  const Convergence exact = curve("exact", {{0.1, 4e-9}, {0.4, 3e-9}});
  const RaceRecord seen = races_of({exact, curve("biased", {{2, 9e-6}, {8, 8e-6}})}).at(0);
  EXPECT_EQ(seen.relmse, 2e-6);
  EXPECT_EQ(order_of(seen), (std::vector<std::string>{"exact", "biased"}));
  EXPECT_NEAR(seen.times[1].ratio->value, 80, 1e-9);
  EXPECT_EQ(races_of({exact, curve("biased", {{2, 9e-7}, {8, 8e-7}})}).at(0).undecided,
            "the measured errors decide no order: exact 4e-09 to 3e-09, biased 9e-07 to 8e-07");
}

TEST(Race, of_an_engine_with_two_kinds_of_budget_counts_the_faster) {
  const std::vector<RaceRecord> races = races_of(
      {curve("a", {{1, 0.04}, {4, 0.01}}), curve("a", {{0.5, 0.04}, {2, 0.01}}), curve("b", {{2, 0.04}, {8, 0.01}})});
  EXPECT_EQ(races.at(0).relmse, 0.02);
  EXPECT_EQ(races.at(0).times.at(0).engine, "a");
  EXPECT_EQ(races.at(0).times.at(0).seconds, 1);
  EXPECT_NEAR(races.at(0).times.at(1).ratio->value, 4, 1e-9);
}

// Errors of 0.2 to 0.1 and of 0.02 to 0.01 have nothing in common, and neither time settles the order.
TEST(Race, without_a_common_error_says_so) {
  const auto races = races_of({curve("rough", {{1, 0.2}, {2, 0.1}}), curve("fine", {{4, 0.02}, {8, 0.01}})});
  ASSERT_EQ(races.size(), 1u);
  EXPECT_TRUE(races[0].times.empty());
  EXPECT_EQ(races[0].undecided, "the measured errors decide no order: rough 0.2 to 0.1, fine 0.02 to 0.01");
}

TEST(Race, of_an_engine_whose_error_grows_says_so) {
  const auto races = races_of({curve("lucky", {{1, 0.01}, {2, 1}}), curve("other", {{1, 0.1}, {2, 0.01}})});
  ASSERT_EQ(races.size(), 1u);
  EXPECT_EQ(races[0].undecided.substr(0, 45), "lucky: error grows from 0.01 at =0 to 1 at =0");
}

TEST(Race, is_run_by_an_engine_whose_small_budget_took_longer_by_chance) {
  EXPECT_FALSE(
      races_of({curve("busy", {{3, 0.04}, {2, 0.01}}), curve("other", {{1, 0.1}, {4, 0.01}})})[0].times.empty());
}

TEST(Race, needs_two_engines) {
  EXPECT_TRUE(races_of({curve("path", {{1, 0.1}, {2, 0.05}})}).empty());
  Convergence rounding = curve("path", {{1, 1e-12}});
  rounding.points[0].undefined[own_error_key] = "it is rounding";
  EXPECT_EQ(races_of({rounding, curve("other", {{1, 0.1}})}).at(0).undecided, std::string("path: ") + no_own_error);
}

}  // namespace
}  // namespace photonproof::inline harness_conclusions
