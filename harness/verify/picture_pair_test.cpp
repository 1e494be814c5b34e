#include "harness/verify/picture_pair.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "harness/verify/stale_reference.h"

namespace photonproof::inline harness_verify {
namespace {

constexpr int kWidth = 32, kHeight = 24;

/// A gradient with normal noise of this standard deviation a pixel, known to its variance layer.
EnginePicture noisy(std::uint64_t seed, double gain = 1, double deviation = 0.02, double known = 0) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  EnginePicture picture;
  picture.engine = "engine";
  picture.rendering.mean = Image(kWidth, kHeight);
  picture.rendering.variance = Image(kWidth, kHeight);
  for (std::size_t i = 0; i < picture.rendering.mean.rgb.size(); ++i) {
    const double light = 0.3 + 0.5 * static_cast<double>(i % (3 * kWidth)) / (3 * kWidth);
    picture.rendering.mean.rgb[i] = static_cast<float>(gain * light + deviation * normal(random));
    const double stated = known > 0 ? known : deviation;
    picture.rendering.variance->rgb[i] = static_cast<float>(stated * stated);
  }
  return picture;
}

TEST(PairTest, equal_pictures_differ_at_most_by_chance) {
  int differ = 0;
  for (std::uint64_t pair = 0; pair < 60; ++pair) differ += test_pair(noisy(2 * pair + 1), noisy(2 * pair + 2)).differs;
  EXPECT_EQ(differ, 0);  // pair_alpha is 1e-4
}

// 768 pixels of a mean of 0.55 with deviations of 0.02 in both give an error of the mean of 0.02 sqrt(2/768) / 0.55 =
// 0.19 %. At the level of 1e-4 / 3 / 3 (4.4 deviations) and power 0.99 (2.3) an error of 1.2 % is detected.
TEST(PairTest, says_which_error_it_would_have_seen) {
  const PairTest test = test_pair(noisy(1), noisy(2));
  ASSERT_TRUE(test.would_see.has_value());
  EXPECT_NEAR(*test.would_see, 0.0125, 0.002);
  EXPECT_TRUE(test_pair(noisy(1), noisy(2, 1.015)).differs);
  EXPECT_FALSE(test_pair(noisy(1), noisy(2, 1.0005)).differs);
}

TEST(PairTest, declared_errors_are_no_difference_and_larger_ones_are) {
  EnginePicture biased = noisy(2, 1.015, 0.001);
  biased.declared = {0.02, 0.1, "says so"};
  EXPECT_FALSE(test_pair(noisy(1, 1, 0.001), biased).differs);
  biased = noisy(2, 1.03, 0.001);
  biased.declared = {0.02, 0.1, "says so"};
  const PairTest test = test_pair(noisy(1, 1, 0.001), biased);
  EXPECT_TRUE(test.differs);
  EXPECT_EQ(test.sentence, "+3 % over the whole image");
  EXPECT_GT(*test.would_see, 0.02);
}

TEST(PairTest, place_and_channel_of_a_difference_are_named) {
  EnginePicture other = noisy(2, 1, 0.004);
  for (int y = 8; y < 16; ++y)
    for (int x = 16; x < 24; ++x) other.rendering.mean.pixel(x, y)[0] *= 0.8f;
  const PairTest test = test_pair(noisy(1, 1, 0.004), other);
  ASSERT_TRUE(test.differs);
  ASSERT_EQ(test.tiles.size(), 1u);
  EXPECT_EQ(test.tiles[0].x, 16);
  EXPECT_EQ(test.tiles[0].y, 8);
  EXPECT_NE(test.sentence.find("red only"), std::string::npos) << test.sentence;
  EXPECT_EQ(test.channels, (std::array<bool, 3>{true, false, false}));
}

/// A uniform picture with almost no noise, plus light in samples worth 1, a hundredth a pixel on average.
EnginePicture with_fireflies(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::poisson_distribution<int> hits(0.01);
  EnginePicture picture = noisy(seed + 1000, 1, 1e-4);
  for (std::size_t pixel = 0; pixel < picture.rendering.mean.pixels(); ++pixel) {
    const int n = hits(random);
    for (std::size_t c = 0; c < 3; ++c) {
      picture.rendering.mean.rgb[3 * pixel + c] += static_cast<float>(n);
      picture.rendering.variance->rgb[3 * pixel + c] += static_cast<float>(n);
    }
  }
  return picture;
}

// The expected picture is brighter by 0.01 everywhere. Two thirds of the blocks of 64 pixels contain some of that
// light, and the others are certain of having none.
TEST(PairTest, light_that_comes_in_few_bright_samples_proves_nothing_where_it_is_missing) {
  EnginePicture expected = noisy(1, 1, 1e-4);
  for (float& v : expected.rendering.mean.rgb) v += 0.01f;
  int undecided = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const PairTest test = test_pair(expected, with_fireflies(seed));
    EXPECT_FALSE(test.differs) << seed << ": " << test.sentence;
    undecided += test.is_undecided ? 1 : 0;
  }
  EXPECT_GT(undecided, 50);  // their variances alone would call them different
}

// The light of a channel is at most 768 x 0.8 = 615, and 6 / 1e-4 times that is 3.7e7. The noise of a pixel with the
// value 3e36 would hide it.
TEST(PairTest, pixel_with_more_light_than_chance_gives_differs_whatever_its_noise) {
  EnginePicture odd = noisy(2);
  odd.engine = "odd";
  odd.rendering.mean.pixel(5, 7)[1] = 3e36f;
  odd.rendering.variance->pixel(5, 7)[1] = 1e38f;
  for (const PairTest& test : {test_pair(noisy(1), odd), test_pair(odd, noisy(1))}) {
    EXPECT_TRUE(test.differs);
    EXPECT_TRUE(test.has_outlier);
    EXPECT_EQ(test.sentence, "pixel (5, 7) of odd is 3e+36 and holds more than 6e+04 times all light of the other");
  }
  odd.rendering.mean.pixel(5, 7)[1] = 1e6f;  // a bright sample may be chance
  EXPECT_FALSE(test_pair(noisy(1), odd).has_outlier);
  EXPECT_TRUE(test_against_closed_form({0.5, 0.5, 0.5},
                                       [] {
                                         EnginePicture bright = noisy(3);
                                         bright.rendering.mean.pixel(1, 2)[0] = 3e36f;
                                         bright.rendering.variance->pixel(1, 2)[0] = 1e38f;
                                         return bright;
                                       }())
                  .has_outlier);
}

// Two pictures that are similar by chance would make any third one differ.
TEST(PairTest, engine_that_shows_its_noise_by_fewer_pictures_than_gates_need_is_undecided) {
  EnginePicture odd = noisy(2, 1.5);
  odd.engine = "odd";
  odd.images = {odd.rendering.mean, odd.rendering.mean};
  const PairTest test = test_pair(noisy(1), odd);
  EXPECT_FALSE(test.differs);
  EXPECT_TRUE(test.is_undecided);
  EXPECT_EQ(test.sentence, "odd has no variance, and fewer than 3 images do not show its noise");
  odd.images.push_back(odd.rendering.mean);
  EXPECT_TRUE(test_pair(noisy(1), odd).differs);
}

TEST(PairTest, whole_shift_is_what_the_sentence_says) {
  EnginePicture odd = noisy(2, 1, 0.001);
  for (std::size_t i = 0; i < odd.rendering.mean.rgb.size(); i += 3) odd.rendering.mean.rgb[i] *= 2;
  const PairTest test = test_pair(noisy(1, 1, 0.001), odd);
  EXPECT_NEAR(test.whole_shift, 1, 0.01);  // red alone, whose mean has an error of 0.02 %
  EXPECT_NE(test.sentence.find("red only"), std::string::npos) << test.sentence;
}

TEST(PairTest, more_than_bright_samples_carry_differs_beside_them) {
  EnginePicture expected = noisy(1, 1, 1e-4);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth / 2; ++x)
      for (std::size_t c = 0; c < 3; ++c) expected.rendering.mean.pixel(x, y)[c] *= 0.5f;  // 384 pixels darker by 0.2
  const PairTest test = test_pair(expected, with_fireflies(1));
  EXPECT_TRUE(test.differs);
  EXPECT_FALSE(test.is_undecided);
}

// A tile of 8 x 8 is 30 % darker: 64 of 768 pixels, so that the whole image is about 2.5 % darker.
TEST(PairTest, largest_difference_is_that_of_the_worst_tile) {
  const EnginePicture first = noisy(1, 1, 0.002);
  EnginePicture second = noisy(2, 1, 0.002);
  for (int y = 8; y < 16; ++y)
    for (int x = 8; x < 16; ++x)
      for (std::size_t c = 0; c < 3; ++c)
        second.rendering.mean.rgb[3 * static_cast<std::size_t>(y * kWidth + x) + c] *= 0.7f;
  EXPECT_NEAR(largest_difference(test_pair(first, second), first, second), 0.3, 0.01);
  const EnginePicture equal = noisy(3, 1, 0.002);
  EXPECT_LT(largest_difference(test_pair(first, equal), first, equal), 0.001);
}

TEST(PairTest, of_a_closed_form_is_of_the_mean) {
  // Neighbouring values of the gradient are channels.
  const auto mean = [](int c) { return 0.3 + 0.5 * (3.0 * (kWidth - 1) / 2 + c) / (3 * kWidth); };
  const RgbD stated(mean(0), mean(1), mean(2));
  EXPECT_FALSE(test_against_closed_form(stated, noisy(3)).differs);
  const PairTest test = test_against_closed_form(stated, noisy(3, 1.02));
  EXPECT_TRUE(test.differs);
  EXPECT_NEAR(test.shift[1], 0.02, 0.005);
}

TEST(StoredReference, that_is_off_to_one_side_with_its_own_noise_is_stale) {
  const ReferenceState state = state_of_reference(noisy(1, 1.05), noisy(2, 1, 0.005));
  EXPECT_TRUE(state.is_stale) << state.sentence;
  EXPECT_EQ(state.sentence.rfind("stale reference: it differs by +5", 0), 0u) << state.sentence;
}

TEST(StoredReference, whose_pixels_scatter_more_than_it_says_is_damaged) {
  const ReferenceState state = state_of_reference(noisy(1, 1.05, 0.06, 0.01), noisy(2, 1, 0.005));
  EXPECT_FALSE(state.is_stale);
  EXPECT_EQ(state.sentence.rfind("damaged reference", 0), 0u) << state.sentence;
}

TEST(StoredReference, that_is_off_in_both_directions_is_another_picture) {
  EnginePicture reference = noisy(1, 1, 0.01);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      for (std::size_t c = 0; c < 3; ++c) reference.rendering.mean.pixel(x, y)[c] *= x < kWidth / 2 ? 1.2f : 0.85f;
  const ReferenceState state = state_of_reference(reference, noisy(2, 1, 0.005));
  EXPECT_FALSE(state.is_stale);
  EXPECT_NE(state.sentence.find("both directions"), std::string::npos) << state.sentence;
}

}  // namespace
}  // namespace photonproof::inline harness_verify
