#include "harness/metrics/metric_bounds.h"

#include <gtest/gtest.h>

#include "harness/metrics/metric_run.h"
#include "harness/metrics/test_images.h"
#include "scenes/base/input_error.h"

namespace photonproof::inline harness_metrics {
namespace {

std::string refusal(const std::string& text) {
  try {
    parse_bound("--fail", text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

/// Measurements with bias -0.25 in all channels; mse 0.0625.
std::vector<Measurement> dark_by_a_quarter(int side) {
  const Image reference = constant_image(side, side, 1, 1, 1);
  const Image test = constant_image(side, side, 0.75f, 0.75f, 0.75f);
  return measure(reference, test, {});
}

TEST(MetricBounds, maximum_is_kept_up_to_itself) {
  const auto measured = dark_by_a_quarter(12);
  EXPECT_FALSE(broken_bound(parse_bound("--fail", "mse=0.0625"), measured));
  EXPECT_EQ(broken_bound(parse_bound("--fail", "mse=0.0624"), measured), "mse 0.0625 is over its maximum 0.0624");
}

TEST(MetricBounds, minimum_is_kept_down_to_itself) {
  const Image image = busy_image(12, 12);
  const auto measured = measure(image, image, {});
  EXPECT_FALSE(broken_bound(parse_bound("--fail", "ssim=1"), measured));
  EXPECT_EQ(broken_bound(parse_bound("--fail", "ssim=1.5"), measured), "ssim 1 is under its minimum 1.5");
}

TEST(MetricBounds, infinite_psnr_keeps_every_bound) {
  const Image image = busy_image(12, 12);
  EXPECT_FALSE(broken_bound(parse_bound("--fail", "psnr=1e9"), measure(image, image, {})));
}

TEST(MetricBounds, bias_is_bounded_by_its_absolute_value) {
  const auto measured = dark_by_a_quarter(12);
  EXPECT_FALSE(broken_bound(parse_bound("--fail", "bias=0.25"), measured));
  EXPECT_EQ(broken_bound(parse_bound("--fail", "bias_g=0.2"), measured),
            "bias_g -0.25 is in absolute value over its maximum 0.2");
}

TEST(MetricBounds, metric_without_a_value_breaks_its_bound) {
  EXPECT_EQ(
      broken_bound(parse_bound("--fail", "ssim=0"), dark_by_a_quarter(10)),
      "ssim has no value here (a side is under 11 pixels, or the mask has no whole window), so its bound is not kept");
}

TEST(MetricBounds, unknown_metric_names_the_nearest) {
  EXPECT_EQ(refusal("ssmi=0.9"),
            "--fail: error: unknown metric 'ssmi'; the nearest is 'ssim', and compare --help lists all");
  EXPECT_EQ(refusal("RelMSE=0.9"),
            "--fail: error: unknown metric 'RelMSE'; the nearest is 'relmse', and compare --help lists all");
}

TEST(MetricBounds, malformed_bounds_say_what_was_expected) {
  EXPECT_EQ(refusal("ssim"), "--fail: error: expected metric=bound, for example ssim=0.95, got 'ssim'");
  EXPECT_EQ(refusal("ssim=high"), "--fail: error: the bound of ssim is 'high', which is not a finite decimal number");
  EXPECT_NE(refusal("ssim=nan"), "accepted");
  EXPECT_EQ(refusal("ssim="), "--fail: error: the bound of ssim is empty, expected a number");
  EXPECT_NE(refusal("ssim=0.9x"), "accepted");
}

}  // namespace
}  // namespace photonproof::inline harness_metrics
