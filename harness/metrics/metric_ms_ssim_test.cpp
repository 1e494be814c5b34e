#include <gtest/gtest.h>

#include <cmath>

#include "harness/metrics/test_images.h"
#include "harness/metrics/test_oracle_table.h"

namespace photonproof::inline harness_metrics {
namespace {

/// The image repeated up to this size.
Image repeated(const Image& image, int width, int height) {
  Image large(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) std::copy_n(image.pixel(x % image.width, y % image.height), 3, large.pixel(x, y));
  return large;
}

TEST(MsSsim, agrees_with_the_independent_implementation) {
  const auto pairs = read_oracle_table("ms_ssim_expected.csv");
  ASSERT_EQ(pairs.size(), 2u);
  for (const OraclePair& pair : pairs) {
    const int width = static_cast<int>(pair.expected.at("width")),
              height = static_cast<int>(pair.expected.at("height"));
    EXPECT_NEAR(metric_value("ms_ssim", repeated(pair.reference, width, height), repeated(pair.test, width, height),
                             pair.exposure)
                    .value(),
                pair.expected.at("ms_ssim"), 1e-7)
        << pair.name;
  }
}

TEST(MsSsim, of_two_constants_is_the_luminance_term_of_the_last_scale) {
  // Contrast and structure are 1 at every scale; luminance enters once: (1e-4 / 1.0001)^0.1333.
  const Image white = constant_image(170, 180, 1, 1, 1);
  const Image black = constant_image(170, 180, 0, 0, 0);
  EXPECT_NEAR(metric_value("ms_ssim", white, black).value(), std::pow(1e-4 / 1.0001, 0.1333), 1e-9);
}

TEST(MsSsim, is_left_out_where_the_last_scale_has_no_whole_window) {
  // Halved four times, rounding up, 161 is 11 and 160 is 10.
  EXPECT_TRUE(metric_value("ms_ssim", busy_image(161, 161), busy_image(161, 161, 1, 2)));
  EXPECT_FALSE(metric_value("ms_ssim", busy_image(160, 300), busy_image(160, 300, 1, 2)));
  EXPECT_FALSE(metric_value("ms_ssim", busy_image(300, 160), busy_image(300, 160, 1, 2)));
}

TEST(MsSsim, is_undefined_where_structures_are_opposed) {
  // A checkerboard against its negative: the first scale's structure term has a negative mean.
  Image board(170, 170), negative(170, 170);
  for (int y = 0; y < 170; ++y)
    for (int x = 0; x < 170; ++x)
      for (int c = 0; c < 3; ++c) {
        board.pixel(x, y)[c] = (x + y) % 2 ? 0.8f : 0.1f;
        negative.pixel(x, y)[c] = (x + y) % 2 ? 0.1f : 0.8f;
      }
  EXPECT_FALSE(metric_value("ms_ssim", board, negative));
  EXPECT_LT(metric_value("ssim", board, negative).value(), 0);
}

}  // namespace
}  // namespace photonproof::inline harness_metrics
