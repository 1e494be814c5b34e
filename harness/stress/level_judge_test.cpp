// Tests the judging of levels with synthetic pictures whose errors are known.

#include "harness/stress/level_judge.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "scenes/images/mean_error.h"

namespace photonproof::inline harness_stress {
namespace {

/// 24 x 24 pixels of `mean`, each with a deviation of 1 %, alternately up and down so that the mean of all is exact.
Rendering noisy(float mean, float deviation = 0.01f) {
  Rendering rendering;
  rendering.mean = Image(24, 24);
  rendering.variance = Image(24, 24);
  for (int y = 0; y < 24; ++y)
    for (int x = 0; x < 24; ++x)
      for (int c = 0; c < 3; ++c) {
        rendering.mean.pixel(x, y)[c] = mean * (1 + ((x + y) % 2 == 0 ? deviation : -deviation));
        rendering.variance->pixel(x, y)[c] = mean * mean * deviation * deviation;
      }
  return rendering;
}

LevelEvidence showing(const Rendering& picture) {
  LevelEvidence evidence;
  evidence.picture = picture;
  evidence.ending = "exited with 0";
  return evidence;
}

LevelExpectation exactly(const Rendering& picture, double factor = 1) {
  LevelExpectation expected;
  expected.picture = picture;
  expected.factor = factor;
  expected.is_exact = true;
  return expected;
}

TEST(levels, with_the_picture_they_should_have_are_right) {
  const LevelVerdict verdict = judge_level(showing(noisy(1)), exactly(noisy(1)));
  EXPECT_EQ(verdict.outcome, LevelOutcome::right) << verdict.sentence;
  ASSERT_TRUE(verdict.would_see);
  EXPECT_LT(*verdict.would_see, 0.01);  // 1.4 % over sqrt(576) pixels is 0.06 %; some six of these are detectable
}

TEST(levels, are_compared_after_their_factor) {
  EXPECT_EQ(judge_level(showing(noisy(1e15f)), exactly(noisy(1), 1e15)).outcome, LevelOutcome::right);
  EXPECT_EQ(judge_level(showing(noisy(1e15f)), exactly(noisy(1), 1.02e15)).outcome, LevelOutcome::silently_wrong);
}

TEST(levels, off_by_more_than_noise_are_silently_wrong_or_said) {
  LevelEvidence evidence = showing(noisy(1.02f));
  EXPECT_EQ(judge_level(evidence, exactly(noisy(1))).outcome, LevelOutcome::silently_wrong);
  evidence.losses = {"scene.xml:1:1: alpha 0 is rendered as 0.1"};
  const LevelVerdict verdict = judge_level(evidence, exactly(noisy(1)));
  EXPECT_EQ(verdict.outcome, LevelOutcome::degraded);
  EXPECT_TRUE(verdict.is_wrong);
  EXPECT_NE(verdict.sentence.find("alpha 0"), std::string::npos) << verdict.sentence;
}

TEST(levels, that_are_biased_by_nature_may_be_off_by_three_percent) {
  LevelExpectation expected = exactly(noisy(1));
  expected.is_exact = false;
  EXPECT_EQ(judge_level(showing(noisy(1.02f)), expected).outcome, LevelOutcome::right);
  EXPECT_EQ(judge_level(showing(noisy(1.06f)), expected).outcome, LevelOutcome::silently_wrong);
}

TEST(levels, that_are_right_need_no_claim_of_a_bias_as_an_excuse) {
  LevelExpectation expected = exactly(noisy(1));
  expected.is_exact = false;
  LevelEvidence right = showing(noisy(1)), wrong = showing(noisy(1.2f));
  EXPECT_EQ(judge_level(wrong, expected).outcome, LevelOutcome::silently_wrong);
  right.relative_bias = wrong.relative_bias = 0.06;  // four times this plus 3 % exceeds the largest error that a level
                                                     // may miss
  EXPECT_EQ(judge_level(right, expected).outcome, LevelOutcome::right);
  EXPECT_LT(*judge_level(right, expected).would_see, level_power);
  EXPECT_EQ(judge_level(wrong, expected).outcome, LevelOutcome::undecided);
  EXPECT_GT(*judge_level(wrong, expected).would_see, level_power);
}

TEST(levels, with_values_that_are_no_numbers_are_wrong) {
  Rendering picture = noisy(1);
  picture.mean.rgb[7] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(judge_level(showing(picture), exactly(noisy(1))).outcome, LevelOutcome::silently_wrong);
}

TEST(levels, that_lost_their_variance_have_to_say_so) {
  // 1e30 squared is beyond a float.
  Rendering picture = noisy(1e30f);
  for (float& v : picture.variance->rgb) v = std::numeric_limits<float>::max();
  LevelEvidence evidence = showing(picture);
  EXPECT_EQ(judge_level(evidence, exactly(noisy(1), 1e30)).outcome, LevelOutcome::silently_wrong);
  evidence.losses = {"the variance is beyond single precision"};
  EXPECT_EQ(judge_level(evidence, exactly(noisy(1), 1e30)).outcome, LevelOutcome::right);
}

TEST(levels, of_faint_light_have_their_variance_as_long_as_a_float_holds_it) {
  // (1e-16 x 1 %)^2 = 1e-36.
  EXPECT_EQ(judge_level(showing(noisy(1e-16f)), exactly(noisy(1), 1e-16)).outcome, LevelOutcome::right);
  EXPECT_EQ(judge_level(showing(noisy(1.02e-16f)), exactly(noisy(1), 1e-16)).outcome, LevelOutcome::silently_wrong);
}

TEST(levels, whose_pixels_vary_together_are_judged_by_the_error_of_the_mean) {
  // The mean of independent pixels would be off by 1.4 % over sqrt(576), at most some four times that: by 0.24 %.
  Rendering picture = noisy(1.0028e5f);
  EXPECT_EQ(judge_level(showing(picture), exactly(noisy(1), 1e5)).outcome, LevelOutcome::silently_wrong);
  store_mean_error(picture, {{200, 200, 200}, 30});
  EXPECT_EQ(judge_level(showing(picture), exactly(noisy(1), 1e5)).outcome, LevelOutcome::right);
}

TEST(levels, of_engines_that_tell_no_variance_are_judged_by_their_means) {
  LevelEvidence evidence = showing(noisy(1.01f));
  evidence.picture->variance.reset();
  LevelExpectation expected = exactly(noisy(1));
  expected.is_exact = false;
  EXPECT_EQ(judge_level(evidence, expected).outcome, LevelOutcome::silently_wrong);  // our engines have one
  evidence.states_noise = false;
  EXPECT_EQ(judge_level(evidence, expected).outcome, LevelOutcome::right);
  expected.picture->variance.reset();
  EXPECT_EQ(judge_level(evidence, expected).outcome, LevelOutcome::right);
  evidence.picture = noisy(1.1f);
  evidence.picture->variance.reset();
  EXPECT_EQ(judge_level(evidence, expected).outcome, LevelOutcome::silently_wrong);
}

TEST(levels, whose_pixels_err_together_may_be_off_by_that) {
  LevelEvidence evidence = showing(noisy(1.06f));
  LevelExpectation expected = exactly(noisy(1));
  expected.is_exact = false;
  EXPECT_EQ(judge_level(evidence, expected).outcome, LevelOutcome::silently_wrong);
  store_mean_error(*evidence.picture, {{0.01, 0.01, 0.01}, 8});  // 4.5 of these, and the 3 % of a photon mapper
  EXPECT_EQ(judge_level(evidence, expected).outcome, LevelOutcome::undecided);
  store_mean_error(*evidence.picture, {{0.0075, 0.0075, 0.0075}, 8});
  EXPECT_EQ(judge_level(evidence, expected).outcome, LevelOutcome::right);
  evidence.picture = noisy(1.08f);
  store_mean_error(*evidence.picture, {{0.01, 0.01, 0.01}, 8});
  EXPECT_EQ(judge_level(evidence, expected).outcome, LevelOutcome::silently_wrong);
}

/// A row of 200 blocks of 8 x 8 pixels about 1. Each pixel has a deviation of 10 %, and each block as a whole deviates
/// by as much or by `off`.
Rendering of_common_errors(float off = 0.1f) {
  Rendering rendering;
  rendering.mean = Image(1600, 8);
  rendering.variance = Image(1600, 8);
  std::mt19937 generator(1);
  std::normal_distribution<float> error(0, off);
  for (int block = 0; block < 200; ++block) {
    const float value = 1 + error(generator);
    for (int y = 0; y < 8; ++y)
      for (int x = 8 * block; x < 8 * (block + 1); ++x)
        for (int c = 0; c < 3; ++c) {
          rendering.mean.pixel(x, y)[c] = value;
          rendering.variance->pixel(x, y)[c] = 0.01f;
        }
  }
  return rendering;
}

TEST(levels, whose_blocks_err_as_a_whole_are_judged_by_how_blocks_do) {
  LevelExpectation one;
  one.radiance = 1;
  Rendering picture = of_common_errors();
  const LevelVerdict noise = judge_level(showing(picture), one);
  EXPECT_EQ(noise.outcome, LevelOutcome::right) << noise.sentence;
  for (int y = 0; y < 8; ++y)
    for (int x = 800; x < 808; ++x) picture.mean.pixel(x, y)[0] = 4;
  EXPECT_EQ(judge_level(showing(picture), one).outcome, LevelOutcome::silently_wrong);
  // Blocks that deviate by more than their pixels' noise are wrong, however many do.
  EXPECT_EQ(judge_level(showing(of_common_errors(0.6f)), one).outcome, LevelOutcome::silently_wrong);
}

TEST(levels, whose_noise_would_hide_an_error_are_undecided) {
  EXPECT_EQ(judge_level(showing(noisy(1, 0.9f)), exactly(noisy(1, 0.9f))).outcome, LevelOutcome::undecided);
}

TEST(levels, know_whose_noise_hides_an_error) {
  LevelExpectation expected = exactly(noisy(1, 0.3f));
  for (const bool is_exact : {true, false}) {
    expected.is_exact = is_exact;
    EXPECT_NEAR(judge_level(showing(noisy(1, 0.3f)), expected).share_of_expected, 0.5, 1e-6);
    EXPECT_NEAR(judge_level(showing(noisy(1, 0.1f)), expected).share_of_expected, 0.9, 1e-6);
    Rendering spike = noisy(1, 0.1f);
    spike.variance->rgb.front() = 1e3f;  // rare and bright
    EXPECT_NEAR(judge_level(showing(spike), expected).share_of_expected, 0.9, 1e-3);
  }
  // Means of pixels that err together: 0.01^2 of 0.01^2 + 0.02^2.
  LevelEvidence evidence = showing(noisy(1));
  store_mean_error(*evidence.picture, {{0.02, 0.02, 0.02}, 8});
  store_mean_error(*expected.picture, {{0.01, 0.01, 0.01}, 8});
  EXPECT_NEAR(judge_level(evidence, expected).share_of_expected, 0.2, 1e-6);
  LevelExpectation one;
  one.radiance = 1;
  EXPECT_EQ(judge_level(showing(noisy(1, 0.3f)), one).share_of_expected, 0);
}

TEST(levels, are_refused_by_an_error_and_crash_without_one) {
  LevelEvidence evidence;
  evidence.message = "scene.xml:1:1: error: is no number";
  evidence.refused = true;
  EXPECT_EQ(judge_level(evidence, {}).outcome, LevelOutcome::refused);
  evidence.refused = false;
  evidence.ending = "killed by SIGSEGV";
  EXPECT_EQ(judge_level(evidence, {}).outcome, LevelOutcome::crashed);
}

TEST(levels, of_what_is_no_number_must_be_refused) {
  LevelExpectation expected;
  expected.must_refuse = true;
  EXPECT_EQ(judge_level(showing(noisy(1)), expected).outcome, LevelOutcome::silently_wrong);
}

TEST(levels, see_light_where_there_is_none) {
  LevelExpectation dark;
  dark.radiance = 0;
  dark.is_exact = true;
  EXPECT_EQ(judge_level(showing(noisy(1e-9f)), dark).outcome, LevelOutcome::silently_wrong);
  EXPECT_EQ(judge_level(showing(noisy(0)), dark).outcome, LevelOutcome::right);
}

}  // namespace
}  // namespace photonproof::inline harness_stress
