#include "harness/conclusions/error_split.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "harness/statistics/relative_error.h"

namespace photonproof::inline harness_conclusions {
namespace {

constexpr int side = 48;

// A smooth image between 0.2 and 1.8.
Image truth() {
  Image image(side, side);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      for (int c = 0; c < 3; ++c)
        image.pixel(x, y)[c] = static_cast<float>(1 + 0.8 * std::sin(0.2 * x + c) * std::cos(0.15 * y));
  return image;
}

// The truth times `scale`, with normal noise whose standard deviation grows by a factor of 4 from left to right.
Image noisy(double sd, double scale, std::mt19937_64& generator) {
  std::normal_distribution<double> normal;
  Image image = truth();
  for (std::size_t i = 0; i < image.rgb.size(); ++i) {
    const double across = static_cast<double>(i / 3 % side) / side;
    image.rgb[i] = static_cast<float>(scale * image.rgb[i] + sd * (0.5 + 1.5 * across) * normal(generator));
  }
  return image;
}

// Variance of the noise of noisy(sd, ...).
Image variance_image(double sd) {
  Image image(side, side);
  for (std::size_t i = 0; i < image.rgb.size(); ++i)
    image.rgb[i] = static_cast<float>(std::pow(sd * (0.5 + 1.5 * static_cast<double>(i / 3 % side) / side), 2));
  return image;
}

bool holds(const std::optional<Interval>& interval, double value) {
  return interval->low <= value && value <= interval->high;
}

// Mean over the image of w sd(x)^2, which is the relative variance of noisy(sd, 1), and without bias its relmse.
double expected_variance(double sd) { return relative_variance(truth(), variance_image(sd)); }

// Nominal 95 %; 100 experiments have a standard error of 2.2 %.
TEST(ErrorSplit, interval_of_an_unbiased_engines_bias_holds_zero) {
  int bias_held = 0, relmse_held = 0;
  for (std::uint64_t experiment = 0; experiment < 100; ++experiment) {
    std::mt19937_64 generator(experiment);
    const std::vector<Image> images{noisy(0.1, 1, generator), noisy(0.1, 1, generator), noisy(0.1, 1, generator)};
    const ErrorSplit split = split_error(truth(), nullptr, images);
    bias_held += holds(split.bias2->interval, 0);
    relmse_held += holds(split.relmse.interval, expected_variance(0.1));
  }
  EXPECT_GE(bias_held, 88);
  EXPECT_GE(relmse_held, 88);
}

// A reference with noise of its own, v = (0.1/4)^2: without v, bias2 would be v's share instead of 0.
TEST(ErrorSplit, noise_of_the_reference_is_not_taken_for_bias) {
  int held = 0, held_without = 0;
  for (std::uint64_t experiment = 0; experiment < 50; ++experiment) {
    std::mt19937_64 generator(1000 + experiment);
    const Image reference = noisy(0.025, 1, generator), variance = variance_image(0.025);
    const std::vector<Image> images{noisy(0.1, 1, generator), noisy(0.1, 1, generator), noisy(0.1, 1, generator),
                                    noisy(0.1, 1, generator)};
    held += holds(split_error(reference, &variance, images).bias2->interval, 0);
    held_without += holds(split_error(reference, nullptr, images).bias2->interval, 0);
  }
  EXPECT_GE(held, 43);
  EXPECT_LE(held_without, 5);
}

// The reference states twice its true v. Taken as exact, `bias2` seems to be -v; taken as a bound, its interval holds
// 0.
TEST(ErrorSplit, overstated_noise_of_the_reference_is_no_negative_bias) {
  std::mt19937_64 generator(11);
  const Image reference = noisy(0.025, 1, generator), variance = variance_image(0.025 * std::sqrt(2.0));
  std::vector<Image> images;
  for (int k = 0; k < 8; ++k) images.push_back(noisy(0.05, 1, generator));
  EXPECT_FALSE(holds(split_error(reference, &variance, images).bias2->interval, 0));
  EXPECT_TRUE(holds(split_error(reference, &variance, images, ReferenceVariance::upper_bound).bias2->interval, 0));
}

// Everything 5 % too bright: bias2 = mean of (0.05 r)^2 / (r^2 + 0.01).
TEST(ErrorSplit, planted_bias_is_recovered) {
  double expected = 0;
  for (const float r : truth().rgb) expected += 0.0025 * r * r * relative_weight(r);
  expected /= 3.0 * side * side;
  std::mt19937_64 generator(5);
  const std::vector<Image> images{noisy(0.1, 1.05, generator), noisy(0.1, 1.05, generator), noisy(0.1, 1.05, generator),
                                  noisy(0.1, 1.05, generator)};
  const ErrorSplit split = split_error(truth(), nullptr, images);
  EXPECT_TRUE(holds(split.bias2->interval, expected)) << split.bias2->value << " for " << expected;
  EXPECT_GT(split.bias2->interval->low, 0);
  EXPECT_NEAR(split.variance->value, expected_variance(0.1), 0.05 * expected_variance(0.1));
  EXPECT_TRUE(holds(split.variance->interval, expected_variance(0.1)));
}

// For every set of images mean relmse = bias2 + variance (here v = 0), since E (x - r)^2 = (m - r)^2 + (K-1)/K s^2.
TEST(ErrorSplit, parts_add_up_to_the_whole) {
  std::mt19937_64 generator(6);
  const std::vector<Image> images{noisy(0.2, 1.1, generator), noisy(0.2, 1.1, generator)};
  const ErrorSplit split = split_error(truth(), nullptr, images);
  EXPECT_NEAR(split.relmse.value, split.bias2->value + split.variance->value, 1e-12);
  EXPECT_NEAR(split.relmse.value, (relative_mse(truth(), images[0]) + relative_mse(truth(), images[1])) / 2, 1e-12);
}

// (0.2 - 0.1)^2/(0.1^2 + 0.01) = 1/2, as the metric of `compare` has it; the images' spread 0.01 weighs the same.
TEST(ErrorSplit, errors_are_relative_as_relmse_is) {
  Image reference(8, 8), test(8, 8), spread(8, 8);
  std::fill(reference.rgb.begin(), reference.rgb.end(), 0.1f);
  std::fill(test.rgb.begin(), test.rgb.end(), 0.2f);
  std::fill(spread.rgb.begin(), spread.rgb.end(), 0.01f);
  EXPECT_NEAR(relative_mse(reference, test), 0.5, 1e-6);
  EXPECT_NEAR(relative_variance(reference, spread), 0.5, 1e-6);
}

// As `noisy`, times 1 + a for the whole image, a normal with this deviation.
Image noisy_together(double sd, double together, std::mt19937_64& generator) {
  std::normal_distribution<double> normal(0, together);
  const double scale = 1 + normal(generator);
  return noisy(sd, scale, generator);
}

// Nominal 95 %; the standard error is 2.2 % over 100 experiments. Blocks alone would find a bias that does not exist in
// a sixth to a third of them.
TEST(ErrorSplit, noise_of_the_whole_image_is_not_taken_for_bias) {
  for (const std::size_t count : {2u, 3u, 5u})
    for (const double together : {0.005, 0.02, 0.05}) {
      int held = 0;
      constexpr int experiments = 100;
      for (std::uint64_t experiment = 0; experiment < experiments; ++experiment) {
        std::mt19937_64 generator(7000 + experiment);
        std::vector<Image> images;
        for (std::size_t k = 0; k < count; ++k) images.push_back(noisy_together(0.1, together, generator));
        held += split_error(truth(), nullptr, images).bias2->interval->low <= 0;
      }
      EXPECT_GE(held, experiments * (0.95 - 0.066)) << count << " images, " << together;
    }
}

// Here relmse is nearly that of the common factor alone, which is chi^2 of one degree of freedom. The interval of 2
// images holds it least often, since Student's t assumes normal logarithms.
TEST(ErrorSplit, interval_of_relmse_holds_it_where_pixels_share_noise) {
  double expected = 0;
  for (const float r : truth().rgb) expected += 0.0025 * r * r * relative_weight(r);
  expected = expected / (3.0 * side * side) + expected_variance(0.01);
  for (const std::size_t count : {2u, 3u, 5u}) {
    int held = 0;
    constexpr int experiments = 100;
    for (std::uint64_t experiment = 0; experiment < experiments; ++experiment) {
      std::mt19937_64 generator(9000 + experiment);
      std::vector<Image> images;
      for (std::size_t k = 0; k < count; ++k) images.push_back(noisy_together(0.01, 0.05, generator));
      held += holds(split_error(truth(), nullptr, images).relmse.interval, expected);
    }
    EXPECT_GE(held, experiments * 0.88) << count;
  }
}

// Against black a value x has the relmse x^2 / 0.01.
Image grey(float value) {
  Image image(16, 16);
  std::fill(image.rgb.begin(), image.rgb.end(), value);
  return image;
}

// The relMSEs 0.04, 0.16 and 0.36 have mean 0.186667, standard deviation 0.161658, standard error 0.0933333. Student's
// t(0.975; 2) = 4.302653, so exp(+-2.151325) times the mean. Bias: the mean image is off by 0.4, variance 0.04, h =
// 4.302653 sqrt(0.04 / 3) = 0.496828, (0.4 + h)^2 = 0.804300. Variance: 2 * 0.04 / chi^2(0.975; 2) = 0.08 / 7.377759,
// and 0.08 / 0.0506356.
TEST(ErrorSplit, intervals_of_three_images_that_share_all_noise_are_those_of_three_numbers) {
  const ErrorSplit split = split_error(grey(0), nullptr, std::vector<Image>{grey(0.02f), grey(0.04f), grey(0.06f)});
  EXPECT_NEAR(split.relmse.value, 0.186667, 1e-6);
  EXPECT_NEAR(split.relmse.interval->low, 0.186667 * std::exp(-2.151325), 1e-6);
  EXPECT_NEAR(split.relmse.interval->high, 0.186667 * std::exp(2.151325), 1e-5);
  EXPECT_NEAR(split.bias2->value, 0.16 - 0.04 / 3, 1e-6);
  EXPECT_EQ(split.bias2->interval->low, 0);
  EXPECT_NEAR(split.bias2->interval->high, 0.804300, 1e-5);
  EXPECT_NEAR(split.variance->value, 0.04, 1e-6);
  EXPECT_NEAR(split.variance->interval->low, 0.0108434, 1e-6);
  EXPECT_NEAR(split.variance->interval->high, 1.579916, 1e-4);
}

// The reference here has a variance of 1e-4, which is 0.01 relative to 0.01. It is subtracted from bias2 and added to
// h^2: sqrt(4.302653^2 0.04 / 3 + 0.01) = 0.506792.
TEST(ErrorSplit, variance_of_the_reference_is_taken_from_the_bias_and_added_to_its_uncertainty) {
  const Image variance = grey(1e-4f);
  const ErrorSplit split = split_error(grey(0), &variance, std::vector<Image>{grey(0.02f), grey(0.04f), grey(0.06f)});
  EXPECT_NEAR(split.bias2->value, 0.16 - 0.04 / 3 - 0.01, 1e-6);
  EXPECT_NEAR(split.bias2->interval->high, std::pow(0.4 + 0.506792, 2), 1e-5);
}

// Two images, 0.02 in one half and 0.04 in the other, and the reverse: both have the relMSE 0.1. A block of 48 values
// differs by 48 (0.16 - 0.04) = 5.76, so its variance is 5.76^2/2. The mean of two images summed over 16 blocks has 16
// * 5.76^2/4 = 11.52^2, relative to 0.1 * 768 values 0.15, times 1.959964.
TEST(ErrorSplit, interval_of_relmse_of_independent_blocks_is_the_normal_one) {
  std::vector<Image> images(2, grey(0.02f));
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x)
      for (int c = 0; c < 3; ++c) images[x < 8 ? 0 : 1].pixel(x, y)[c] = 0.04f;
  const ErrorSplit split = split_error(grey(0), nullptr, images);
  EXPECT_NEAR(split.relmse.interval->high / split.relmse.value, std::exp(0.1500 * 1.959964), 1e-5);
  EXPECT_NEAR(split.relmse.interval->low / split.relmse.value, std::exp(-0.1500 * 1.959964), 1e-5);
}

// A pixel of squared error 12 among 255 of 1 has 12 / 267 = 4.5 %; one of 14 has 14 / 269 = 5.2 %.
TEST(ErrorSplit, error_of_which_one_pixel_has_a_twentieth_has_no_interval) {
  for (const double of_one : {12.0, 14.0}) {
    std::vector<Image> images{grey(0.02f), grey(0.02f), grey(0.02f)};
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t i = k % 2; i < images[k].rgb.size(); i += 2) images[k].rgb[i] *= -1;
      for (int c = 0; c < 3; ++c) images[k].pixel(5, 5)[c] *= static_cast<float>(std::sqrt(of_one));
    }
    const ErrorSplit split = split_error(grey(0), nullptr, images);
    EXPECT_NEAR(split.share_of_a_pixel, of_one / (255 + of_one), 1e-6);
    EXPECT_EQ(split.is_of_few_pixels(), of_one == 14);
    EXPECT_EQ(split.relmse.interval.has_value(), of_one == 12);
    EXPECT_EQ(split.bias2->interval.has_value(), of_one == 12);
  }
}

TEST(ErrorSplit, one_image_tells_nothing_of_its_spread) {
  std::mt19937_64 generator(7);
  const std::vector<Image> images{noisy(0.2, 1, generator)};
  const ErrorSplit split = split_error(truth(), nullptr, images);
  EXPECT_FALSE(split.relmse.interval);
  EXPECT_FALSE(split.bias2);
  EXPECT_FALSE(split.variance);
}

// Eight images of 144 blocks, whose error sums have 12 times the variance of independent blocks: r = 11/143 between two
// blocks, which only the sum of all shows. Its ratio is 12 chi^2_7 / 7, above the 1 % bound of 18.475/7 with
// probability 0.98. The variance's interval then is that of 8 numbers, 7/1.690 up.
TEST(ErrorSplit, noise_that_all_blocks_share_a_little_is_seen_in_their_sum) {
  std::mt19937_64 generator(5);
  std::normal_distribution<double> normal;
  int seen = 0;
  constexpr int experiments = 50;
  for (int e = 0; e < experiments; ++e) {
    // A block's sum of 48 values: own variance 48, common variance c^2 48^2, with 144 c^2 48^2 = 11 (48 + c^2 48^2).
    const double common_sd = std::sqrt(11.0 / 133 / 48);
    std::vector<Image> images;
    for (int k = 0; k < 8; ++k) {
      const double common = common_sd * normal(generator);
      Image image(side, side);
      for (float& v : image.rgb) v = static_cast<float>(1 + 0.01 * (common + normal(generator)));
      images.push_back(image);
    }
    Image even(side, side);
    for (float& v : even.rgb) v = 1;
    const Estimate variance = *split_error(even, nullptr, images, ReferenceVariance::exact).variance;
    seen += variance.interval->high > 4 * variance.value;
  }
  EXPECT_GE(seen, 45);
}

}  // namespace
}  // namespace photonproof::inline harness_conclusions
