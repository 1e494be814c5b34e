#include "harness/grading/scene_judge.h"

#include <gtest/gtest.h>

#include <cmath>

#include "harness/pixels/likeness.h"
#include "harness/statistics/batch_means.h"
#include "scenes/base/splitmix.h"

namespace photonproof::inline harness_grading {
namespace {

constexpr int side = 32;

// A gradient times `gain`, with noise of standard deviation 0.03 by the seed.
Image noisy_image(std::uint64_t seed, double gain = 1, double deviation = 0.03) {
  Image image(side, side);
  for (std::size_t i = 0; i < image.rgb.size(); ++i) {
    double noise = 0;  // from 12 uniform numbers: variance 1
    for (std::uint64_t k = 0; k < 12; ++k)
      noise += static_cast<double>(splitmix64(seed * 1000 + k, i) >> 11) * 0x1p-53 - 0.5;
    const double clean = 0.2 + 0.4 * static_cast<double>(i % (3 * side)) / (3 * side);
    image.rgb[i] = static_cast<float>(clean * gain + deviation * noise);
  }
  return image;
}

SceneReference noisy_reference(int images = 8) {
  BatchMeans means(side, side, 1);
  for (int k = 0; k < images; ++k) means.add(noisy_image(1000 + static_cast<std::uint64_t>(k)), "test");
  return {means.rendering(), images, static_cast<double>(images - 1), "test"};
}

CorrectnessRule rule(double flip, double relative) {
  CorrectnessRule rule;
  if (flip > 0) rule.metrics.push_back(parse_bound("test", "flip=" + std::to_string(flip)));
  if (relative > 0) rule.blocks = BlockBound{relative, 0.001};
  return rule;
}

SceneJudgement judge(const CorrectnessRule& by, const std::vector<Image>& images, bool may_draw = true) {
  std::vector<const Image*> pointers;
  for (const Image& image : images) pointers.push_back(&image);
  return judge_scene(by, noisy_reference(), pointers, may_draw);
}

TEST(SceneJudge, an_independent_image_is_right) {
  EXPECT_EQ(judge(rule(0.3, 0.1), {noisy_image(1), noisy_image(2)}).verdict, SceneVerdict::right);
}

TEST(SceneJudge, far_beyond_a_bound_one_image_decides) {
  const SceneJudgement judgement = judge(rule(0.1, 0), {noisy_image(1, 2)});
  EXPECT_TRUE(judgement.decided);
  EXPECT_EQ(judgement.verdict, SceneVerdict::wrong);
  EXPECT_EQ(judgement.sentence.rfind("flip is 0.", 0), 0u) << judgement.sentence;
}

TEST(SceneJudge, near_a_bound_more_images_are_asked_for) {
  const double flip = judge(rule(1, 0), {noisy_image(1)}).checks[0].value.value;
  EXPECT_FALSE(judge(rule(flip * 1.1, 0), {noisy_image(1)}).decided);
  EXPECT_FALSE(judge(rule(flip * 0.9, 0), {noisy_image(1)}).decided);
  EXPECT_TRUE(judge(rule(flip * 1.5, 0), {noisy_image(1)}).decided);
  EXPECT_TRUE(judge(rule(flip * 0.7, 0), {noisy_image(1)}).decided);
}

// The 99 % interval of a metric's mean is Student's: mean +- t s / sqrt(n), for n = 3 with t(.995, 2) = 9.925 (any
// table of quantiles). It is 73 % off without 1/sqrt(n), 18 % with a divisor n for n - 1, and 41 % with one more degree
// of freedom.
TEST(SceneJudge, the_interval_of_a_metric_is_of_its_mean) {
  std::vector<Image> images;
  std::vector<double> values;
  for (const double deviation : {0.02, 0.03, 0.05}) {
    images.push_back(noisy_image(images.size() + 1, 1, deviation));
    values.push_back(judge(rule(1, 0), {images.back()}).checks[0].value.value);
  }
  const double mean = (values[0] + values[1] + values[2]) / 3;
  const double squares = std::pow(values[0] - mean, 2) + std::pow(values[1] - mean, 2) + std::pow(values[2] - mean, 2);
  const double margin = 9.925 * std::sqrt(squares / 2) / std::sqrt(3);
  const GradedCheck check = judge(rule(mean, 0), images).checks[0];
  EXPECT_NEAR(check.value.value, mean, 1e-9);
  EXPECT_NEAR(check.value.interval->high - mean, margin, 0.001 * margin);
  EXPECT_NEAR(mean - check.value.interval->low, margin, 0.001 * margin);
}

// An image 30 % too dark has a bias of -.3, halfway between .1 and .5, by definition; its noise is 1 % of that.
TEST(SceneJudge, a_wrong_image_keeps_its_share_of_the_points) {
  CorrectnessRule by = rule(0.3, 0);
  const auto share = [&](double gain) {
    const Image image = noisy_image(1, gain);
    const Image* const only = &image;
    return partial_share(by, noisy_reference(), {&only, 1});
  };
  EXPECT_EQ(share(0.7), 0);
  by.partial = PartialCredit{&metric_named("test", "bias"), 0.1, 0.5};
  EXPECT_NEAR(share(0.7), 0.5, 0.02);
  EXPECT_NEAR(share(1.3), 0.5, 0.02);
  EXPECT_EQ(share(0.95), 1);
  EXPECT_EQ(share(0.4), 0);
}

TEST(SceneJudge, images_that_are_all_alike_are_judged_by_their_value) {
  const double flip = judge(rule(1, 0), {noisy_image(1)}).checks[0].value.value;
  const std::vector<Image> alike{noisy_image(1), noisy_image(1)};
  EXPECT_EQ(judge(rule(flip * 1.001, 0), alike).verdict, SceneVerdict::right);
  EXPECT_EQ(judge(rule(flip * 0.999, 0), alike).verdict, SceneVerdict::wrong);
  EXPECT_TRUE(judge(rule(flip * 0.999, 0), alike).decided);
}

TEST(SceneJudge, what_noise_leaves_open_at_the_end_is_borderline) {
  const std::vector<Image> images{noisy_image(1, 1, 0.01), noisy_image(2, 1, 0.05)};
  double mean = 0;
  for (const Image& image : images) mean += judge(rule(1, 0), {image}).checks[0].value.value / 2;
  const SceneJudgement open = judge(rule(mean, 0), images, true);
  EXPECT_FALSE(open.decided);
  const SceneJudgement judgement = judge(rule(mean, 0), images, false);
  EXPECT_TRUE(judgement.decided);
  EXPECT_EQ(judgement.verdict, SceneVerdict::borderline);
}

TEST(SceneJudge, a_uniform_loss_beyond_the_blocks_bound_is_wrong) {
  std::vector<Image> images;
  for (std::uint64_t k = 0; k < 4; ++k) images.push_back(noisy_image(10 + k, 0.8));
  const SceneJudgement judgement = judge(rule(0, 0.08), images);
  EXPECT_EQ(judgement.verdict, SceneVerdict::wrong);
  EXPECT_NE(judge(rule(0, 0.4), images).verdict, SceneVerdict::wrong);
}

// The mean of 8 x 8 pixels of deviation s is known to about s/8: blocks do not show 2 % in images whose noise is 20 %.
TEST(SceneJudge, blocks_too_noisy_to_tell_are_right_and_may_hide_a_mistake) {
  std::vector<Image> images;
  for (std::uint64_t k = 0; k < 4; ++k) images.push_back(noisy_image(10 + k, 1, 0.2));
  const SceneJudgement noisy = judge(rule(0, 0.02), images);
  EXPECT_EQ(noisy.verdict, SceneVerdict::right);
  EXPECT_EQ(noisy.checks.back().side, GradedCheck::Side::undecided);
  EXPECT_EQ(noisy.sentence, "");
  const SceneJudgement clear = judge(rule(0, 0.5), images);
  EXPECT_EQ(clear.verdict, SceneVerdict::right);
  EXPECT_EQ(clear.checks.back().side, GradedCheck::Side::inside);
}

TEST(SceneJudge, one_image_is_not_wrong_by_blocks_before_its_noise_is_known) {
  EXPECT_FALSE(judge(rule(0, 0.001), {noisy_image(1)}).decided);
}

TEST(Likeness, a_copy_has_the_references_noise_and_an_independent_image_has_not) {
  const SceneReference reference = noisy_reference();
  const Rendering& of = reference.rendering;
  EXPECT_TRUE(has_noise_of(of.mean, of.mean, *of.variance, 0));
  EXPECT_FALSE(has_noise_of(noisy_image(1), of.mean, *of.variance, 0));
  EXPECT_FALSE(has_noise_of(noisy_image(1, 1, 0), of.mean, *of.variance, 0));  // without noise of its own
  Image rounded = of.mean;
  for (float& v : rounded.rgb) v = std::round(v * 255) / 255;
  EXPECT_TRUE(has_noise_of(rounded, of.mean, *of.variance, 1 / 255.0));
}

TEST(Likeness, two_images_of_the_same_seed_are_alike_and_of_two_are_not) {
  const Image variance = variance_of_one(noisy_reference());
  EXPECT_TRUE(has_noise_of(noisy_image(1), noisy_image(1), variance, 0));
  EXPECT_FALSE(has_noise_of(noisy_image(1), noisy_image(2), variance, 0));
}

TEST(Likeness, where_rounding_is_all_the_noise_nothing_is_said) {
  const Image image = noisy_image(1, 1, 0);
  Image variance(side, side);
  for (float& v : variance.rgb) v = 1e-6f;  // 8/12 of a step's square would be 1e-5
  EXPECT_FALSE(has_noise_of(image, image, variance, 1 / 255.0));
}

}  // namespace
}  // namespace photonproof::inline harness_grading
