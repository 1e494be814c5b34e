// Noise that pixels share, made of known parts.
#include "harness/statistics/shared_noise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace photonproof::inline harness_statistics {
namespace {

constexpr int side = 64;  // 64 blocks

/// Parts of a value's normal noise, as standard deviations.
struct Parts {
  double pixel = 0.1, block = 0, image = 0;
};

std::vector<Image> noisy_images(std::mt19937_64& random, int count, const Parts& parts) {
  std::normal_distribution<double> normal;
  std::vector<Image> images(static_cast<std::size_t>(count), Image(side, side));
  for (Image& image : images) {
    const double of_image = parts.image * normal(random);
    std::vector<double> of_blocks(64);
    for (double& value : of_blocks) value = parts.block * normal(random);
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x)
        for (int c = 0; c < 3; ++c) {
          const double of_block = of_blocks[static_cast<std::size_t>(y / 8 * 8 + x / 8)];
          image.pixel(x, y)[c] = static_cast<float>(1 + of_image + of_block + parts.pixel * normal(random));
        }
  }
  return images;
}

SharedNoise shared_in(std::mt19937_64& random, int count, const Parts& parts, const Image* variance = nullptr) {
  const std::vector<Image> images = noisy_images(random, count, parts);
  std::vector<const Image*> pointers;
  for (const Image& image : images) pointers.push_back(&image);
  return shared_noise(pointers, std::size_t{0}, variance);
}

TEST(shared_noise, is_not_seen_in_independent_pixels_more_often_than_its_level) {
  // 60 sets of images at a level of 0.01: more than 4 have the probability 0.0003.
  for (const int count : {3, 8, 16}) {
    std::mt19937_64 random(5);
    int within = 0, between = 0;
    for (int run = 0; run < 60; ++run) {
      const SharedNoise shared = shared_in(random, count, {});
      within += shared.is_within_blocks(0.01) ? 1 : 0;
      between += shared.is_between_blocks(0.01) ? 1 : 0;
    }
    EXPECT_LE(within, 4) << count;
    EXPECT_LE(between, 4) << count;
  }
}

TEST(shared_noise, within_blocks_has_the_ratio_of_equally_correlated_pixels) {
  // A block's part of 0.05 beside a pixel's of 0.1: the correlation is 0.0025 / 0.0125 = 0.2, the ratio 1 + 63 0.2 =
  // 13.6. The 64 blocks and 31 degrees of freedom estimate it to sqrt(2 / 1984) = 3.2 %; 4 deviations are 13 %.
  std::mt19937_64 random(6);
  const SharedNoise shared = shared_in(random, 32, {.block = 0.05});
  EXPECT_NEAR(shared.within_blocks, 13.6, 1.8);
  EXPECT_TRUE(shared.is_within_blocks());
  EXPECT_FALSE(shared.is_between_blocks());
  EXPECT_GT(shared.independent_blocks, 55);
}

TEST(shared_noise, over_the_image_leaves_as_many_independent_blocks_as_their_correlation_says) {
  // A block's own part is 0.1 / 8 = 0.0125. An image's of as much: all correlations are 1/2, the squares sum up to
  // 64 + 64 63 / 4 = 1072, and 64^2 / 1072 = 3.82. The image's variance, of 127 degrees of freedom, is known to 12.5 %,
  // r^2 = (v / (v + 1))^2 as well.
  std::mt19937_64 random(7);
  const SharedNoise shared = shared_in(random, 128, {.image = 0.0125});
  EXPECT_NEAR(shared.independent_blocks, 3.82, 1.2);
  EXPECT_TRUE(shared.is_between_blocks());
}

TEST(shared_noise, of_one_per_cent_over_the_image_is_seen_in_eight_images) {
  // Correlations of 0.0001 / (0.0001 + 0.00015625) = 0.39.
  std::mt19937_64 random(8);
  int seen = 0;
  for (int run = 0; run < 50; ++run) seen += shared_in(random, 8, {.image = 0.01}).is_between_blocks() ? 1 : 0;
  EXPECT_GE(seen, 45);
}

TEST(shared_noise, is_measured_by_the_variances_that_images_state) {
  // Layers that state a quarter of the pixels' variance make the ratio four.
  std::mt19937_64 random(9);
  Image stated(side, side);
  std::fill(stated.rgb.begin(), stated.rgb.end(), 0.0025f);
  EXPECT_NEAR(shared_in(random, 32, {}, &stated).within_blocks, 4, 0.5);
}

TEST(shared_noise, is_none_where_images_have_no_noise) {
  std::mt19937_64 random(10);
  const SharedNoise shared = shared_in(random, 8, {.pixel = 0});
  EXPECT_EQ(shared.blocks, 0u);
  EXPECT_EQ(shared.within_blocks, 1);
  EXPECT_FALSE(shared.is_within_blocks());
  EXPECT_FALSE(shared.is_between_blocks());
}

}  // namespace
}  // namespace photonproof::inline harness_statistics
