// The quantities of uncertainty that gates use, each against a number worked out by hand: degrees of freedom, variances
// of references, numbers of images. An error of one per cent fails here.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "harness/statistics/deviations.h"
#include "harness/statistics/gate_statistics.h"
#include "harness/statistics/student.h"

namespace photonproof::inline harness_statistics {
namespace {

constexpr int side = 32;  // 16 blocks
constexpr double per_cent = 0.01;

Rendering reference_of(float mean, float variance) {
  Rendering reference{Image(side, side), Image(side, side), {}};
  std::fill(reference.mean.rgb.begin(), reference.mean.rgb.end(), mean);
  std::fill(reference.variance->rgb.begin(), reference.variance->rgb.end(), variance);
  return reference;
}

std::vector<const Image*> pointers(const std::vector<Image>& images) {
  std::vector<const Image*> all;
  for (const Image& image : images) all.push_back(&image);
  return all;
}

void expect_relative(double value, double expected, const char* what) {
  EXPECT_NEAR(value / expected, 1, per_cent) << what << ": " << value << ", expected " << expected;
}

// Four images of noise d in one of three orthogonal patterns a pixel: every pixel's sample variance is s^2 = 4 d^2 / 3.
// Eight pixels of a block have its pattern, the other 56 cancel in pairs. The block's mean is d/8 times the pattern,
// its variance s^2/64, that of 64 independent pixels. Six, five and five of the 16 blocks share a pattern. Their
// squared correlations sum up to 36 + 25 + 25 = 86, no more than chance's 16 + 16 15/3 = 96.
constexpr std::array<std::array<int, 4>, 3> patterns{{{1, 1, -1, -1}, {1, -1, 1, -1}, {1, -1, -1, 1}}};

std::vector<Image> balanced_images(double d) {
  std::vector<Image> images(4, Image(side, side));
  for (std::size_t k = 0; k < images.size(); ++k)
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        const auto block = static_cast<std::size_t>(y / 8 * 4 + x / 8);
        const double sign = y % 8 == 0 || x % 2 == 0 ? 1 : -1;
        const float value = static_cast<float>(1 + d * sign * patterns[block % 3][k]);
        std::fill_n(images[k].pixel(x, y), 3, value);
      }
  return images;
}

TEST(uncertainty, of_images_is_their_variance_over_their_number) {
  constexpr double d = 0.3, s2 = 4 * d * d / 3;
  const std::vector<Image> images = balanced_images(d);
  const Deviations found = measure_deviations(reference_of(1, 0), pointers(images), {.reference_freedom = 1e9});
  for (std::size_t c = 0; c < 3; ++c) {
    for (const Deviation& pixel : found.pixels[c]) expect_relative(std::pow(pixel.standard_error, 2), s2 / 4, "pixel");
    for (const Deviation& block : found.blocks[c])
      expect_relative(std::pow(block.standard_error, 2), s2 / 64 / 4, "block");
    // The image's mean is d/8 (6 a + 5 b + 5 c)/16 of the patterns.
    expect_relative(std::pow(found.whole[c].standard_error, 2), s2 / 64 * 86 / 256 / 4, "whole");
  }
}

// All ratios are equal, so that an expectation is worth its independent parts: 63 more pixels of 3 degrees beside a
// pixel's own 3. Blocks of four images surely are 16 / (1 + sqrt(2/5) 3/2) = 8.211 independent ones: 6 degrees less one
// are those of symmetric 3 x 3 matrices. The factor 3/2 undoes what chance adds to r^2. The image's mean has 4 - 1.
TEST(uncertainty, of_variances_is_worth_the_degrees_of_freedom_of_independent_parts) {
  const std::vector<Image> images = balanced_images(0.3);
  const Deviations found = measure_deviations(reference_of(1, 0), pointers(images), {.reference_freedom = 1e9});
  for (std::size_t c = 0; c < 3; ++c) {
    expect_relative(found.independent_blocks[c], 8.211, "independent blocks");
    for (const Deviation& pixel : found.pixels[c]) expect_relative(pixel.freedom, 3 * 64, "pixel");
    for (const Deviation& block : found.blocks[c]) expect_relative(block.freedom, 3 * 8.211, "block");
    expect_relative(found.whole[c].freedom, 3, "whole");
  }
}

// Only the reference has noise: v a pixel with f degrees of freedom. A mean over n pixels has the variance v/n and n (f
// + 2) degrees. The reason is that (sum v)^2 / sum v^2 is smaller for estimates than for their truth, by f/(f + 2).
TEST(uncertainty, of_a_reference_is_its_variance_and_its_degrees_of_freedom) {
  constexpr double f = 7;
  constexpr float v = 0.0004f;
  const std::vector<Image> images(4, reference_of(1, 0).mean);
  const Deviations found = measure_deviations(reference_of(1, v), pointers(images), {.reference_freedom = f});
  for (std::size_t c = 0; c < 3; ++c) {
    for (const Deviation& pixel : found.pixels[c]) {
      expect_relative(std::pow(pixel.standard_error, 2), double{v}, "pixel");
      expect_relative(pixel.freedom, f, "pixel's freedom");
    }
    for (const Deviation& block : found.blocks[c]) {
      expect_relative(std::pow(block.standard_error, 2), v / 64, "block");
      expect_relative(block.freedom, (f + 2) * 64, "block's freedom");
    }
    expect_relative(std::pow(found.whole[c].standard_error, 2), v / 1024, "whole");
    expect_relative(found.whole[c].freedom, (f + 2) * 1024, "whole's freedom");
  }
}

// Images have variance a, the reference variance b. The variances add up, and so do the inverse degrees of freedom,
// (a/(a + b))^2 / f_a + (b/(a + b))^2 / f_b (Welch 1947).
TEST(uncertainty, of_images_and_a_reference_is_taken_together) {
  const Deviation found = deviation_of(1.5, 1, {0.03, 3}, {0.01, 7});
  expect_relative(std::pow(found.standard_error, 2), 0.04, "variance");
  expect_relative(found.freedom, 1 / (0.75 * 0.75 / 3 + 0.25 * 0.25 / 7), "freedom");
}

// The least variance from a reference's samples counts where images show none: v over the four images.
TEST(uncertainty, of_images_is_no_less_than_what_is_known_of_one) {
  constexpr float v = 0.0004f;
  const std::vector<Image> images(4, reference_of(1, 0).mean);
  const Rendering known = reference_of(1, v);
  const Deviations found = measure_deviations(reference_of(1, 0), pointers(images),
                                              {.reference_freedom = 1e9, .least_variance = &*known.variance});
  expect_relative(std::pow(found.pixels[0][5].standard_error, 2), v / 4, "pixel");
  expect_relative(std::pow(found.blocks[0][5].standard_error, 2), v / 64 / 4, "block");
}

// One image of four has one sample that adds 8 to one pixel. It adds 8/4 to that pixel's mean, 8/4/64 to a block's and
// 8/4/1024 to the image's, wherever it may be missing.
TEST(uncertainty, of_rare_samples_is_what_one_adds) {
  std::vector<Image> images(4, reference_of(1, 0).mean);
  std::fill_n(images[2].pixel(5, 9), 3, 9.0f);
  const Deviations found = measure_deviations(reference_of(1, 0), pointers(images), {});
  for (std::size_t c = 0; c < 3; ++c) {
    for (const Deviation& pixel : found.pixels[c]) expect_relative(pixel.sample, 2, "pixel");
    for (const Deviation& block : found.blocks[c]) expect_relative(block.sample, 2.0 / 64, "block");
    expect_relative(found.whole[c].sample, 2.0 / 1024, "whole");
  }
}

// D in samples of f each, beside a standard error s: z = D / sqrt(s^2 + f D/2) below the reference, D/s above it. D =
// 3, f = 2, s = 1 give z = 1.5. Conversely D = 3 is the margin at the probability of z = 1.5.
TEST(uncertainty, of_missing_samples_is_that_of_a_poisson_number_of_them) {
  Deviation low;
  low.difference = -3;
  low.standard_error = 1;
  low.sample = 2;
  expect_relative(low.errors(), -1.5, "below");
  Deviation high = low;
  high.difference = 3;
  expect_relative(high.errors(), 3, "above");
  expect_relative(low.margin(0.0668072), 3, "margin at a normal quantile of 1.5");
}

// 1, 2, 3 and 4 have the mean 2.5 and the variance 5/3 of 3 degrees of freedom: 2.5 +- 3.18245 sqrt(5/3/4) at 5 %.
TEST(uncertainty, of_a_metric_is_students_of_its_values) {
  const std::array<double, 4> values{1, 2, 3, 4};
  const Judgement judgement = judge_metric("m", values, BoundKind::maximum, 9, 0.05);
  ASSERT_TRUE(judgement.observed.interval);
  expect_relative(judgement.observed.interval->high - 2.5, 2.05427, "upper half");
  expect_relative(2.5 - judgement.observed.interval->low, 2.05427, "lower half");
}

// An agreement gate gives a fourth of alpha to the whole image, a third of that to a channel: 0.05/12, by Sidak
// 0.0041842, two-sided. Student's quantile of 3 degrees of freedom is 7.9283 there.
TEST(uncertainty, of_the_whole_image_is_shown_at_its_part_of_alpha) {
  const std::vector<Image> images = balanced_images(0.3);
  const Deviations found = measure_deviations(reference_of(1, 0), pointers(images), {.reference_freedom = 1e9});
  const Judgement judgement = judge_agreement(found, {0.02, 0.2}, 0.05);
  ASSERT_TRUE(judgement.observed.interval);
  const double half = (judgement.observed.interval->high - judgement.observed.interval->low) / 2;
  expect_relative(half / found.whole[0].standard_error, 7.9283, "quantile");
}

// The chi^2 of 16 blocks spreads as that of 8 independent ones: the bound is twice the quantile of 8 degrees. That is
// 26.124 at probability 0.001.
TEST(uncertainty, of_dependent_blocks_together_is_that_of_the_independent_ones) {
  std::array<std::vector<Deviation>, 3> blocks;
  for (auto& channel : blocks) channel.assign(16, Deviation{1, 1});
  const double alpha = 1 - std::pow(1 - 0.001, 3);
  expect_relative(chi_square_of_blocks(blocks, {8, 8, 8}, alpha).bound, 2 * 26.124, "bound");
}

}  // namespace
}  // namespace photonproof::inline harness_statistics
