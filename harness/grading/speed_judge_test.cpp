#include "harness/grading/speed_judge.h"

#include <gtest/gtest.h>

#include <cmath>

namespace photonproof {
namespace {

PerformanceRule tiers() {
  PerformanceRule rule;
  rule.tiers = {{2, 20}, {5, 40}};
  return rule;
}

// Rounds of one scene: ratios of the baseline's time, 8 s, to its own.
std::vector<SpeedRound> rounds_of(const std::vector<double>& ratios, double busy = 0) {
  std::vector<SpeedRound> rounds;
  for (const double ratio : ratios) rounds.push_back({{8}, {8 / ratio}, busy});
  return rounds;
}

TEST(SpeedJudge, is_decided_when_the_interval_lies_in_one_tier) {
  const SpeedJudgement judgement = judge_speed(tiers(), {"a"}, rounds_of({3.9, 4, 4.1}), 2, false);
  EXPECT_TRUE(judgement.decided);
  EXPECT_EQ(judgement.grade.state, SpeedGrade::State::measured);
  EXPECT_EQ(judgement.grade.points, 20);
  // Logarithms of 3.9, 4, 4.1: mean ln 3.99917, standard deviation 0.0250; t at 0.5 % with 2 degrees of freedom is
  // 9.925: times exp(+-9.925 0.0250 / sqrt 3) = 1.154.
  EXPECT_NEAR(judgement.grade.speedup.value, 3.99917, 1e-4);
  EXPECT_NEAR(judgement.grade.speedup.interval->high / judgement.grade.speedup.value, 1.154, 0.001);
}

TEST(SpeedJudge, two_rounds_decide_nothing) {
  EXPECT_FALSE(judge_speed(tiers(), {"a"}, rounds_of({3, 3}), 2, false).decided);
}

TEST(SpeedJudge, a_tier_within_the_interval_is_said_and_counts) {
  const SpeedJudgement judgement = judge_speed(tiers(), {"a"}, rounds_of({4.8, 4.9, 5, 5.1}), 2, true);
  EXPECT_FALSE(judgement.decided);
  EXPECT_EQ(judgement.grade.state, SpeedGrade::State::too_noisy);
  EXPECT_LT(judgement.grade.speedup.value, 5);
  EXPECT_EQ(judgement.grade.points, 40);
  EXPECT_NE(judgement.grade.sentence.find("too noisy: 5 times, where 40 points begin, lies within the interval"),
            std::string::npos)
      << judgement.grade.sentence;
}

TEST(SpeedJudge, rounds_beside_other_work_are_left_out) {
  std::vector<SpeedRound> rounds = rounds_of({3.9, 4, 4.1});
  rounds.push_back({{8}, {8}, 1.5});
  EXPECT_NEAR(judge_speed(tiers(), {"a"}, rounds, 2, false).grade.speedup.value, 4, 0.01);
}

TEST(SpeedJudge, nothing_but_rounds_beside_other_work_is_too_noisy) {
  const SpeedJudgement judgement = judge_speed(tiers(), {"a"}, rounds_of({4, 4, 4, 4}, 1), 2, true);
  EXPECT_FALSE(judgement.decided);
  EXPECT_EQ(judgement.grade.state, SpeedGrade::State::too_noisy);
  EXPECT_NE(judgement.grade.sentence.find("too noisy: other work used 1 of 2 cores meanwhile"), std::string::npos)
      << judgement.grade.sentence;
}

TEST(SpeedJudge, a_curve_wants_an_interval_of_two_percent) {
  PerformanceRule rule;
  rule.curve = SpeedTier{16, 60};
  EXPECT_FALSE(judge_speed(rule, {"a"}, rounds_of({3.9, 4, 4.1}), 2, false).decided);
  const SpeedJudgement judgement = judge_speed(rule, {"a"}, rounds_of({3.999, 4, 4.001}), 2, false);
  EXPECT_TRUE(judgement.decided);
  // 4 is half of 16's way, by the logarithm.
  EXPECT_NEAR(judgement.grade.points, 30, 0.01);
}

TEST(SpeedJudge, scenes_count_alike) {
  const std::vector<SpeedRound> rounds(3, SpeedRound{{8, 80}, {4, 10}, 0});
  // sqrt(2 8) = 4
  EXPECT_NEAR(judge_speed(tiers(), {"a", "b"}, rounds, 2, false).grade.speedup.value, 4, 1e-9);
}

TEST(SpeedJudge, slower_than_the_baseline_earns_nothing) {
  PerformanceRule curve;
  curve.curve = SpeedTier{16, 60};
  EXPECT_EQ(points_for(tiers(), 0.5), 0);
  EXPECT_EQ(points_for(curve, 0.5), 0);
  EXPECT_EQ(points_for(curve, 100), 60);
  EXPECT_EQ(points_for(tiers(), 2), 20);
  EXPECT_EQ(rule_text(tiers()), "20 points from 2x, 40 from 5x");
}

}  // namespace
}  // namespace photonproof
