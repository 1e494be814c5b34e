#include "harness/stress/looks.h"

#include <gtest/gtest.h>

namespace photonproof::inline harness_stress {
namespace {

using enum LevelOutcome;

/// The verdict of a level that is right as far as its noise shows.
LevelVerdict verdict(LevelOutcome outcome, double would_see, double allowed = 0, double share_of_expected = 0) {
  LevelVerdict verdict;
  verdict.outcome = outcome;
  verdict.would_see = would_see;
  verdict.allowed = allowed;
  verdict.share_of_expected = share_of_expected;
  return verdict;
}

constexpr double most = 16384;

/// The next look, with 0 samples where there is none.
LevelLook after(const LevelVerdict& verdict, const LevelLook& last) {
  const LevelLook look = next_look(verdict, last, most).value_or(LevelLook{0, 0, 0});
  EXPECT_TRUE(look.samples == 0 || look.number == last.number + 1);
  return look;
}
int samples_after(const LevelVerdict& verdict, const LevelLook& last) { return after(verdict, last).samples; }

TEST(looks, end_where_it_is_known_what_a_level_is) {
  for (const LevelOutcome outcome : {right, refused, crashed}) EXPECT_EQ(samples_after(verdict(outcome, 0.01), {}), 0);
}

TEST(looks, at_what_seems_wrong_are_two) {
  for (const LevelOutcome outcome : {silently_wrong, degraded})
    for (const double would_see : {0.01, 0.5}) {
      LevelVerdict wrong = verdict(outcome, would_see);
      wrong.is_wrong = true;
      EXPECT_EQ(samples_after(wrong, {1, 64}), 256);
      EXPECT_EQ(samples_after(wrong, {2, 256}), 0);
      EXPECT_EQ(next_look(wrong, {1, 64}, 200)->samples, 64);  // for a picture so large that 256 are too many
    }
}

TEST(looks, of_which_noise_is_not_known_are_two) {
  LevelVerdict unknown;
  unknown.outcome = undecided;
  EXPECT_EQ(samples_after(unknown, {1, 64}), 256);
  EXPECT_EQ(samples_after(unknown, {2, 256}), 0);
}

TEST(looks, have_the_samples_that_noise_needs) {
  for (const LevelOutcome outcome : {degraded, undecided}) {
    // Twice 64 samples lower the noise by the root of two, from 0.14 to 0.1; eight times at most.
    EXPECT_EQ(samples_after(verdict(outcome, 0.14), {1, 64}), 128);
    EXPECT_EQ(samples_after(verdict(outcome, 0.15), {1, 64}), 256);
    EXPECT_EQ(samples_after(verdict(outcome, 0.9), {1, 64}), 512);
    EXPECT_EQ(samples_after(verdict(outcome, 0.19), {2, 256}), 1024);
    // The allowed error of the means is not noise: 0.17 of 0.2 must fall to 0.07.
    EXPECT_EQ(samples_after(verdict(outcome, 0.2, 0.03), {2, 256}), 2048);
    EXPECT_EQ(samples_after(verdict(outcome, 0.16, 0.03), {2, 256}), 1024);
  }
}

TEST(looks, leave_out_the_noise_of_what_is_expected) {
  // The square 0.0169 must fall to 0.01. The look's part of it is 0.01352; 0.00662 is left for it: 523 samples.
  EXPECT_EQ(samples_after(verdict(undecided, 0.13, 0, 0.2), {2, 256, 512}), 1024);
  EXPECT_EQ(after(verdict(undecided, 0.13, 0, 0.2), {2, 256, 512}).expected_from, 512);
  // Half of 0.01 is too much for the expected picture: its part falls to a quarter.
  EXPECT_EQ(after(verdict(undecided, 0.12, 0, 0.4), {2, 256, 512}).expected_from, 2048);
  EXPECT_EQ(after(verdict(undecided, 0.6, 0, 0.9), {2, 256, 512}).expected_from, 2048);
  // All noise is the expected picture's.
  const LevelLook as_many = after(verdict(undecided, 0.12, 0, 1), {2, 256, 512});
  EXPECT_EQ(as_many.samples, 256);
  EXPECT_EQ(as_many.expected_from, 2048);
  EXPECT_EQ(after(verdict(undecided, 0.12, 0, 0.9), {3, 1024, 2048}).expected_from, 8192);
  EXPECT_EQ(after(verdict(undecided, 0.12, 0, 0.9), {4, 1024, 8192}).expected_from, 8192);  // half of `most`
}

TEST(looks, are_three_where_noise_cannot_fall_enough) {
  const auto hidden = [](double would_see) { return verdict(undecided, would_see); };
  EXPECT_EQ(samples_after(hidden(5), {1, 64}), 256);
  EXPECT_EQ(samples_after(hidden(5), {2, 256}), 1024);
  EXPECT_EQ(samples_after(hidden(5), {3, 1024}), 0);
  EXPECT_EQ(samples_after(hidden(1e9), {2, 256}), 1024);
  EXPECT_EQ(samples_after(verdict(undecided, 0.2, 0.15), {2, 256}), 1024);
  EXPECT_EQ(samples_after(verdict(undecided, 0.2, 0.15), {3, 1024}), 0);  // 0.15 alone is more than 0.1
  EXPECT_EQ(samples_after(hidden(0.12), {4, 8192}), 16384);
  EXPECT_EQ(samples_after(hidden(0.19), {4, 8192}), 16384);  // 29,575, known to a factor of two
  EXPECT_EQ(samples_after(hidden(0.21), {4, 8192}), 0);      // 36,127
  EXPECT_EQ(samples_after(hidden(0.12), {5, 16384}), 0);
  // Pictures so large that 256 samples are too many.
  EXPECT_EQ(next_look(hidden(0.15), {1, 64}, 100)->samples, 256);
  EXPECT_EQ(next_look(hidden(0.15), {2, 256}, 100)->samples, 1024);
  EXPECT_FALSE(next_look(hidden(0.15), {3, 1024}, 100));
}

}  // namespace
}  // namespace photonproof::inline harness_stress
