#include "harness/conclusions/paired_rounds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace photonproof::inline harness_conclusions {
namespace {

// Rounds whose three times share a disturbance of up to a factor of 2 and differ by noise of `sd` each.
std::vector<PairedRound> rounds_of(std::size_t count, double ratio, double sd, std::uint64_t seed, double control = 1) {
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> normal(0, sd);
  std::uniform_real_distribution<double> disturbance(1, 2);
  std::vector<PairedRound> rounds(count);
  for (PairedRound& round : rounds) {
    const double common = 0.3 * disturbance(generator);
    round.old_seconds = common * std::exp(normal(generator));
    round.new_seconds = ratio * common * std::exp(normal(generator));
    round.again_seconds = control * common * std::exp(normal(generator));
  }
  return rounds;
}

// Adds rounds until there is a verdict, as a session does.
Change sequential(double ratio, double sd, std::uint64_t seed, std::size_t most) {
  const std::vector<PairedRound> all = rounds_of(most, ratio, sd, seed);
  for (std::size_t n = 1; n <= most; ++n) {
    const Change change = judge_seconds(std::span(all).first(n)).change;
    if (change != Change::inconclusive) return change;
  }
  return Change::inconclusive;
}

TEST(PairedRounds, sides_of_the_threshold) {
  EXPECT_EQ(side_of({1.02, 1.04}, 0.015), Change::regression);
  EXPECT_EQ(side_of({0.95, 0.98}, 0.015), Change::improvement);
  EXPECT_EQ(side_of({0.99, 1.01}, 0.015), Change::unchanged);
  EXPECT_EQ(side_of({1.01, 1.02}, 0.015), Change::inconclusive);
  EXPECT_EQ(side_of({0.9, 1.1}, 0.015), Change::inconclusive);
}

TEST(PairedRounds, thresholds_are_one_and_a_half_percent_of_time_and_five_of_error) {
  const auto change_of = [](double seconds, double relmse) {
    std::vector<PairedRound> rounds(6, {1, seconds, 1, 0.01, 0.01 * relmse});
    return std::pair(judge_seconds(rounds).change, judge_relmse(rounds)->change);
  };
  EXPECT_EQ(change_of(1.0147, 1.049), std::pair(Change::unchanged, Change::unchanged));
  EXPECT_EQ(change_of(1.0153, 1.051), std::pair(Change::regression, Change::regression));
}

// Noise of 1 % a run is 1.2 % a round (the new run and the mean of two old ones). 40 rounds determine the median to
// 1.25 * 1.2 % / sqrt(40) = 0.24 %. The threshold is six of these away from 0 and from 3 %.
TEST(PairedRounds, three_percent_are_told_from_none_whatever_disturbs_all_three_alike) {
  int called = 0, false_alarms = 0;
  for (std::uint64_t session = 0; session < 100; ++session) {
    called += sequential(1.03, 0.01, session, 40) == Change::regression;
    false_alarms += sequential(1.00, 0.01, 1000 + session, 40) != Change::unchanged;
  }
  EXPECT_GE(called, 97);
  EXPECT_LE(false_alarms, 3);
}

TEST(PairedRounds, speed_up_of_three_percent_is_an_improvement) {
  EXPECT_EQ(sequential(0.97, 0.005, 3, 40), Change::improvement);
}

TEST(PairedRounds, noise_that_hides_the_change_is_inconclusive) {
  EXPECT_EQ(judge_seconds(rounds_of(10, 1.03, 0.2, 5)).change, Change::inconclusive);
}

// The new program's 1.03 s are compared with the mean of 1 and 1.02 s.
TEST(PairedRounds, new_times_are_compared_with_the_mean_of_both_old_ones) {
  EXPECT_NEAR(judge_seconds(std::vector<PairedRound>(6, {1, 1.03, 1.02, {}, {}})).ratio.value, 1.03 / 1.01, 1e-12);
}

TEST(PairedRounds, session_whose_control_is_faster_than_itself_gives_no_verdict) {
  const RatioVerdict verdict = judge_seconds(rounds_of(20, 0.97, 0.001, 5, 0.99));
  EXPECT_EQ(verdict.change, Change::inconclusive);
  EXPECT_LT(verdict.control->high, 0.995);
}

TEST(PairedRounds, session_whose_control_differs_from_itself_gives_no_verdict) {
  const RatioVerdict verdict = judge_seconds(rounds_of(20, 1.03, 0.001, 5, 1.01));
  EXPECT_EQ(verdict.change, Change::inconclusive);
  EXPECT_GT(verdict.control->low, 1.005);
  EXPECT_EQ(verdict.reason.rfind("this session is noisy: the old program against itself is 1.010 (95 % interval ", 0),
            0u)
      << verdict.reason;
}

// The range of five values holds the median with probability 93.75 % (statistics.h).
TEST(PairedRounds, five_rounds_are_too_few) {
  const RatioVerdict verdict = judge_seconds(rounds_of(5, 2, 0.001, 5));
  EXPECT_EQ(verdict.change, Change::inconclusive);
  EXPECT_EQ(verdict.reason, "5 rounds of at least 6");
}

TEST(PairedRounds, same_images_are_unchanged_after_one_round) {
  std::vector<PairedRound> rounds = rounds_of(1, 1, 0.01, 1);
  rounds[0].old_relmse = rounds[0].new_relmse = 0.02;
  rounds[0].same_image = true;
  EXPECT_EQ(judge_relmse(rounds)->change, Change::unchanged);
}

TEST(PairedRounds, error_is_judged_by_the_ratio_of_its_means) {
  std::vector<PairedRound> rounds = rounds_of(12, 1, 0.01, 1);
  std::mt19937_64 generator(4);
  std::normal_distribution<double> normal(0, 0.02);
  for (PairedRound& round : rounds) {
    round.old_relmse = 0.010 * std::exp(normal(generator));
    round.new_relmse = 0.012 * std::exp(normal(generator));
  }
  const RatioVerdict worse = *judge_relmse(rounds);
  EXPECT_EQ(worse.change, Change::regression);
  EXPECT_NEAR(worse.ratio.value, 1.2, 0.03);  // sd of the ratio: 1.2 * 0.02 * sqrt(2 / 12) = 0.01
  for (PairedRound& round : rounds) std::swap(round.old_relmse, round.new_relmse);
  EXPECT_EQ(judge_relmse(rounds)->change, Change::improvement);
}

// Nominal 95 %; the binomial's standard error is 0.7 % of 1,000 experiments.
TEST(PairedRounds, interval_of_the_errors_ratio_covers_it_as_often_as_it_says) {
  std::mt19937_64 generator(4);
  std::normal_distribution<double> normal(0, 0.1);
  for (const std::size_t count : {6u, 8u, 16u}) {
    int held = 0;
    for (int experiment = 0; experiment < 1000; ++experiment) {
      std::vector<PairedRound> rounds = rounds_of(count, 1, 0.01, 1);
      for (PairedRound& round : rounds) {
        round.old_relmse = 0.010 * std::exp(normal(generator));
        round.new_relmse = 0.012 * std::exp(normal(generator));
      }
      const Interval interval = *judge_relmse(rounds)->ratio.interval;
      held += interval.low <= 1.2 && 1.2 <= interval.high;
    }
    EXPECT_NEAR(held, 950, 22) << count;
  }
}

TEST(PairedRounds, without_a_reference_the_error_is_not_judged) {
  EXPECT_FALSE(judge_relmse(rounds_of(6, 1, 0.01, 1)));
}

TEST(PairedRounds, error_of_zero_has_no_ratio) {
  std::vector<PairedRound> rounds = rounds_of(6, 1, 0.01, 1);
  for (PairedRound& round : rounds) {
    round.old_relmse = 0;
    round.new_relmse = 0.1;
  }
  EXPECT_EQ(judge_relmse(rounds)->change, Change::inconclusive);
}

}  // namespace
}  // namespace photonproof::inline harness_conclusions
