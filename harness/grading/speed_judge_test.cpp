#include "harness/grading/speed_judge.h"

#include <gmock/gmock.h>

#include <cmath>
#include <cstdint>

#include "scenes/base/splitmix.h"

namespace photonproof::inline harness_grading {
namespace {

PerformanceRule tiers() {
  PerformanceRule rule;
  rule.tiers = {{2, 20}, {5, 40}};
  return rule;
}

// Rounds of one scene with these ratios of the baseline's time, 8 s, to the submission's.
std::vector<SpeedRound> rounds_of(const std::vector<double>& ratios, double busy = 0) {
  std::vector<SpeedRound> rounds;
  for (const double ratio : ratios) rounds.push_back({{8}, {8 / ratio}, busy});
  return rounds;
}

TEST(SpeedJudge, is_decided_when_the_interval_lies_in_one_tier) {
  const SpeedJudgement judgement = judge_speed(tiers(), {"a"}, rounds_of({3.95, 4, 4.05}), 2, false);
  EXPECT_TRUE(judgement.decided);
  EXPECT_EQ(judgement.grade.state, SpeedGrade::State::measured);
  EXPECT_EQ(judgement.grade.points, 20);
  // Logarithms of 3.95, 4, 4.05: mean ln 3.99979, standard deviation 0.012501. At most 12 rounds have four looks, at 3,
  // 5, 8 and 12. The t quantile at 0.5 % / 4 with 2 degrees of freedom is 19.962, a factor of exp(19.962 0.012501 /
  // sqrt 3) = 1.155.
  EXPECT_NEAR(judgement.grade.speedup.value, 3.99979, 1e-4);
  EXPECT_NEAR(judgement.grade.speedup.interval->high / judgement.grade.speedup.value, 1.155, 0.001);
  EXPECT_EQ(judgement.grade.sentence, "about 4 times as fast as the baseline, between 3.46 and 4.62");
}

TEST(SpeedJudge, decides_at_looks_only_and_after_the_last_round) {
  const std::vector<SpeedRound> four = rounds_of({3.95, 4, 4.05, 4});
  EXPECT_FALSE(judge_speed(tiers(), {"a"}, four, 2, false).decided);
  EXPECT_TRUE(judge_speed(tiers(), {"a"}, four, 2, true).decided);
  std::vector<std::size_t> looks;
  for (std::size_t rounds = 0; rounds <= 20; ++rounds)
    if (is_speed_look(rounds)) looks.push_back(rounds);
  EXPECT_EQ(looks, (std::vector<std::size_t>{3, 5, 8, 12, 18}));
}

// A submission exactly at a tier's beginning, with noise of 5 % a round, must be decided in at most 1 of 100 cases.
// Looks after each round with intervals of 99 % each would decide some 5 of 100.
TEST(SpeedJudge, looking_often_does_not_decide_what_is_at_a_tiers_beginning) {
  int decided = 0;
  constexpr int sessions = 4000;
  std::uint64_t key = 1;
  const auto unit = [&] { return (static_cast<double>(splitmix64(key++, 7) >> 11) + 0.5) * 0x1p-53; };
  for (int s = 0; s < sessions; ++s) {
    std::vector<double> ratios;
    bool is_over = false;
    for (int round = 1; round <= 12 && !is_over; ++round) {
      ratios.push_back(5 * std::exp(0.05 * std::sqrt(-2 * std::log(unit())) * std::cos(2 * M_PI * unit())));
      const SpeedJudgement judgement = judge_speed(tiers(), {"a"}, rounds_of(ratios), 2, round == 12);
      is_over = judgement.decided;
      if (judgement.grade.state == SpeedGrade::State::measured && is_over) ++decided;
    }
  }
  // At most 40 are expected; 60 are three standard deviations more.
  EXPECT_LE(decided, 60);
  EXPECT_GE(decided, 5);
}

TEST(SpeedJudge, precision_that_is_asked_for_is_waited_for) {
  PerformanceRule rule = tiers();
  rule.precision = 0.1;
  EXPECT_FALSE(judge_speed(rule, {"a"}, rounds_of({3.95, 4, 4.05}), 2, false).decided);
  const SpeedJudgement wide = judge_speed(rule, {"a"}, rounds_of({3.95, 4, 4.05}), 2, true);
  EXPECT_EQ(wide.grade.state, SpeedGrade::State::too_noisy);
  EXPECT_EQ(wide.grade.points, 20);
  EXPECT_NE(wide.grade.sentence.find("too noisy: the interval is 33 % wide; at most 10 % are asked for"),
            std::string::npos)
      << wide.grade.sentence;
  const SpeedJudgement narrow = judge_speed(rule, {"a"}, rounds_of({3.99, 4, 4.01}), 2, false);
  EXPECT_TRUE(narrow.decided);
  EXPECT_EQ(narrow.grade.state, SpeedGrade::State::measured);
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
  EXPECT_NE(judgement.grade.sentence.find("too noisy: the interval contains 5 times, where 40 points begin"),
            std::string::npos)
      << judgement.grade.sentence;
}

// 1, 2.57, 6.6: the logarithms' mean is ln 2.57 and their standard deviation .944, so that the ends are factors of
// exp(19.96 .944 / sqrt 3) away. Only 0 points are certain, where 2.57 alone would be worth 20.
TEST(SpeedJudge, a_speed_up_that_noise_hides_has_the_points_that_are_certain) {
  const SpeedGrade grade = judge_speed(tiers(), {"a"}, rounds_of({1, 2.57, 6.6049}), 2, true).grade;
  EXPECT_EQ(grade.state, SpeedGrade::State::too_noisy);
  EXPECT_NEAR(grade.speedup.value, 2.57, 1e-3);
  EXPECT_EQ(grade.points, 0);
  EXPECT_THAT(grade.sentence, testing::HasSubstr("; points are for the lower end, "));
}

TEST(SpeedJudge, one_round_has_no_interval_and_no_points) {
  const SpeedGrade grade = judge_speed(tiers(), {"a"}, rounds_of({3}), 2, true).grade;
  EXPECT_EQ(grade.points, 0);
  EXPECT_EQ(grade.sentence,
            "3 times as fast as the baseline; too noisy: 1 of at least 3 rounds; no points without an interval");
}

TEST(SpeedJudge, rounds_beside_other_work_are_left_out) {
  std::vector<SpeedRound> rounds = rounds_of({3.95, 4, 4.05});
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
  // 4 is halfway to 16, by the logarithm.
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
}  // namespace photonproof::inline harness_grading
