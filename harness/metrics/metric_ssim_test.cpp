#include <gtest/gtest.h>

#include <cmath>

#include "harness/metrics/test_images.h"
#include "harness/metrics/test_oracle_table.h"

namespace photonproof::inline harness_metrics {
namespace {

TEST(Ssim, agrees_with_scikit_image) {
  const auto pairs = read_oracle_table("ssim_expected.csv");
  ASSERT_EQ(pairs.size(), 4u);
  for (const OraclePair& pair : pairs) {
    // Both compute in double, but an 8-bit image is decoded to float here, with an error of 1e-7.
    EXPECT_NEAR(metric_value("ssim", pair.reference, pair.test, pair.exposure).value(), pair.expected.at("ssim"), 1e-7)
        << pair.name;
  }
}

TEST(Metrics, psnr_and_mse_agree_with_scikit_image) {
  const auto pairs = read_oracle_table("ssim_expected.csv");
  ASSERT_EQ(pairs.size(), 4u);
  for (const OraclePair& pair : pairs)
    for (const std::string name : {"psnr", "mse"}) {
      const double expected = pair.expected.at(name);
      EXPECT_NEAR(metric_value(name, pair.reference, pair.test, pair.exposure).value(), expected, 1e-7 * (1 + expected))
          << pair.name << " " << name;
    }
}

TEST(Ssim, of_two_constants_is_the_luminance_term) {
  // No variance: (2 a b + C1) / (a^2 + b^2 + C1), C1 = 1e-4. Linear 1 and 0 encode to 1 and 0, so 1e-4 / (1 + 1e-4).
  const Image white = constant_image(16, 13, 1, 1, 1);
  const Image black = constant_image(16, 13, 0, 0, 0);
  EXPECT_NEAR(metric_value("ssim", white, black).value(), 1e-4 / 1.0001, 1e-9);
}

TEST(Ssim, is_left_out_where_a_side_is_under_its_window) {
  EXPECT_FALSE(metric_value("ssim", busy_image(10, 40), busy_image(10, 40, 1, 2)));
  EXPECT_FALSE(metric_value("ssim", busy_image(40, 10), busy_image(40, 10, 1, 2)));
  EXPECT_TRUE(metric_value("ssim", busy_image(11, 11), busy_image(11, 11, 1, 2)));
  EXPECT_TRUE(metric_value("flip", busy_image(1, 1), busy_image(1, 1, 1, 2)));  // other metrics work at any size
}

TEST(Ssim, does_not_depend_on_the_order_of_the_images) {
  const Image a = busy_image(30, 20);
  const Image b = busy_image(30, 20, 1, 2);
  EXPECT_NEAR(metric_value("ssim", a, b).value(), metric_value("ssim", b, a).value(), 1e-14);
}

}  // namespace
}  // namespace photonproof::inline harness_metrics
