// Each quantity of uncertainty in `agreement`, on images whose deviations follow by hand. A change of 5 % in a variance
// moves a verdict here, and so do other degrees of freedom. agreement_test.cpp measures the levels over random images.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "harness/statistics/agreement.h"
#include "scenes/images/mean_error.h"

namespace photonproof::inline harness_statistics {
namespace {

using Value = std::function<double(int x, int y)>;

Rendering image_of(int size, const Value& mean, const Value& variance) {
  Rendering image{Image(size, size), Image(size, size), {}};
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x)
      for (int c = 0; c < 3; ++c) {
        image.mean.pixel(x, y)[c] = static_cast<float>(mean(x, y));
        image.variance->pixel(x, y)[c] = static_cast<float>(variance(x, y));
      }
  return image;
}
Value all(double value) {
  return [value](int, int) { return value; };
}
/// `value` in one pixel near the middle, `elsewhere` in the others.
Value one_pixel(double value, double elsewhere) {
  return [=](int x, int y) { return x == 4 && y == 4 ? value : elsewhere; };
}

// A block's variances of .8, 1 and 1.2 have the median 1 and the median absolute deviation .2. The excess kurtosis is
// (1.4826 .2)^2, and the Gamma distribution's shape 6 / 0.0879246 = 68.24. Its tail beyond 6 deviations is that of
// 4.9994 normal ones (scipy.stats.gamma.sf, 1.15), beyond 5 that of 4.2827. With twice the shape: 5.2286 and 4.4523.
TEST(agreement_by_hand, a_pixels_tail_is_as_heavy_as_the_variances_of_its_block_differ) {
  const auto variance = [](int x, int y) { return x == 4 && y == 4 ? 1.0 : 0.8 + 0.2 * ((x + y) % 3); };
  for (const auto& [deviations, normal] : {std::pair{5.0, 4.2827}, std::pair{6.0, 4.9994}}) {
    const Agreement result =
        test_agreement(image_of(16, all(100), all(0)), image_of(16, one_pixel(100 + deviations, 100), variance));
    EXPECT_NEAR(result.pixels.observed, normal, 0.03);  // Wilson and Hilferty's approximation
    EXPECT_EQ(result.pixels.sentence.find("pixel (4, 4)"), 0u) << result.pixels.sentence;
  }
}

// Student's t of 11 degrees of freedom beyond 8 has the tail of 4.5084 normal deviations (scipy.stats.t.sf).
TEST(agreement_by_hand, a_pixel_of_few_passes_is_known_as_well_as_the_image_of_fewer_passes_says) {
  const auto shared = [](const Value& mean, double passes) {
    Rendering image = image_of(16, mean, all(0.5));
    store_mean_error(image, {{1, 1, 1}, passes});
    store_shared_photons(image);
    return image;
  };
  for (const auto& [of_reference, of_test] : {std::pair{12.0, 1e9}, std::pair{1e9, 12.0}, std::pair{12.0, 12.0}})
    EXPECT_NEAR(test_agreement(shared(all(100), of_reference), shared(one_pixel(108, 100), of_test)).pixels.observed,
                4.5084, 1e-3);
}

// All pixels vary together: the mean over the image has the deviation of one pixel. Two images of 12 passes each have
// 22 degrees of freedom. The level of one channel is 0.00111608: its quantile is 3.7468 deviations, the normal
// distribution's 3.2595.
TEST(agreement_by_hand, a_mean_of_pixels_that_vary_together_has_the_deviation_of_one_and_the_freedom_of_its_passes) {
  const auto together = [](double mean, double passes) {
    Rendering image = image_of(16, all(mean), all(1e-4));
    store_mean_error(image, {{0.01, 0.01, 0.01}, passes});
    return image;
  };
  const auto passes = [&](double deviations, double count) {
    const double error = 0.01 * std::sqrt(2.0);
    return test_agreement(together(1, count), together(1 + deviations * error, count)).whole.pass;
  };
  EXPECT_TRUE(passes(3.70, 12));
  EXPECT_FALSE(passes(3.79, 12));
  EXPECT_TRUE(passes(3.22, 1e9));
  EXPECT_FALSE(passes(3.30, 1e9));
}

// A reference of independent pixels, and an image of shared photons without an error of its own. The mean over 256
// pixels has 1/16 of a pixel's deviation. The quantile is the normal distribution's, 3.2595.
TEST(agreement_by_hand, a_plain_mean_of_independent_pixels_has_their_variance_over_their_number) {
  const Rendering reference = image_of(16, all(1), all(0.01));
  const auto passes = [&](double deviations) {
    Rendering test = image_of(16, all(1 + deviations * 0.1 / 16), all(0));
    store_mean_error(test, {{1e-9, 1e-9, 1e-9}, 1e9});
    store_shared_photons(test);
    return test_agreement(reference, test).whole.pass;
  };
  EXPECT_TRUE(passes(3.22));
  EXPECT_FALSE(passes(3.30));
}

// 256 pixels of one variance count alike in the weighed mean, whose deviation is 1/16 of a pixel's.
TEST(agreement_by_hand, a_mean_of_alike_pixels_has_their_variance_over_their_number) {
  const Rendering exact = image_of(16, all(1), all(0)), noisy = image_of(16, all(1 + 2 * 0.1 / 16), all(0.01));
  EXPECT_NEAR(test_agreement(exact, noisy).whole.observed, 2, 1e-3);
  EXPECT_NEAR(test_agreement(noisy, exact).whole.observed, 2, 1e-3);
}

// One pixel of 64 has all of a block's variance: it has 2 degrees of freedom. Student's t of 4 then is a normal deviate
// of 1.90185 (scipy.stats.t.sf), four of which make chi^2 = 14.468. One degree would make it 8.05.
TEST(agreement_by_hand, a_block_whose_noise_is_one_pixels_has_two_degrees_of_freedom) {
  const auto variance = [](int x, int y) { return x % 8 == 4 && y % 8 == 4 ? 0.01 : 0.0; };
  const Agreement result = test_agreement(image_of(16, all(1), all(0)), image_of(16, all(1 + 4 * 0.1 / 64), variance));
  EXPECT_NEAR(result.blocks.observed, 14.468, 0.05);
}

// 25 blocks: the pixels of the middle one have the variance 1, all others 1e-6. A block beside the noisy one may have
// missed such noise. It therefore counts with a fifth of the variance around it, .2 / 9; a far block with its own. An
// error of three deviations of a pixel then is 64e6 .003 / sqrt(16 64 1e6) = 6 of the mean in a far block. Beside the
// noise it is 64 45 .003 / sqrt(16 64 1e6) = 3e-4.
TEST(agreement_by_hand, a_quiet_place_beside_a_noisy_one_counts_little) {
  const auto variance = [](int x, int y) { return x / 8 == 2 && y / 8 == 2 ? 1.0 : 1e-6; };
  const auto off_in = [&](int column, int row) {
    const auto mean = [=](int x, int y) { return x / 8 == column && y / 8 == row ? 1.003 : 1.0; };
    return test_agreement(image_of(40, all(1), all(0)), image_of(40, mean, variance)).whole.observed;
  };
  EXPECT_NEAR(off_in(0, 0), 6, 0.3);
  EXPECT_LT(off_in(1, 2), 0.01);
}

// Splats span four pixels in either image. A block's mean then varies by four times its pixels' variances over their
// number. The sum over 4 blocks of 2 deviations each is chi^2 = 16.
TEST(agreement_by_hand, blocks_vary_by_as_many_pixels_as_a_splat_spans) {
  constexpr double variance = 1e-4;
  const double block_deviation = 2 * std::sqrt(4 * variance / 64);
  for (const bool of_test : {false, true}) {
    Rendering noisy = image_of(16, all(1 + block_deviation), all(variance));
    store_pixels_a_splat(noisy, 4);
    const Rendering exact = image_of(16, all(1), all(0));
    const Agreement result = of_test ? test_agreement(exact, noisy) : test_agreement(noisy, exact);
    EXPECT_NEAR(result.blocks.observed, 16, 0.1) << of_test;
  }
}

}  // namespace
}  // namespace photonproof::inline harness_statistics
