#include "harness/metrics/metric_hdr_flip.h"

#include <gtest/gtest.h>

#include <cmath>

#include "harness/metrics/metric_run.h"
#include "harness/metrics/test_images.h"
#include "harness/metrics/test_oracle_table.h"

namespace photonproof::inline harness_metrics {
namespace {

std::optional<double> hdr_flip(const Image& reference, const Image& test,
                               const std::optional<ExposureRange>& exposures = {}) {
  MetricOptions options;
  options.also = {"hdr_flip"};
  options.parameters.hdr_exposures = exposures;
  for (const Measurement& measured : measure(reference, test, options))
    if (measured.row->name == std::string("hdr_flip")) return measured.value;
  return std::nullopt;
}

TEST(HdrFlip, agrees_with_the_independent_implementation) {
  const auto pairs = read_oracle_table("hdr_flip_expected.csv");
  ASSERT_EQ(pairs.size(), 4u);
  for (const OraclePair& pair : pairs) {
    ImageRowSource reference(pair.reference);
    const ExposureRange range = exposures_of(reference).value();
    // Luminances are floats here and doubles in the expected values.
    EXPECT_NEAR(range.start, pair.expected.at("start"), 1e-6) << pair.name;
    EXPECT_NEAR(range.stop, pair.expected.at("stop"), 1e-6) << pair.name;
    EXPECT_EQ(range.count, pair.expected.at("count")) << pair.name;
    EXPECT_NEAR(hdr_flip(pair.reference, pair.test).value(), pair.expected.at("hdr_flip"), 1e-6) << pair.name;
  }
}

TEST(HdrFlip, of_one_exposure_is_flip_of_the_tone_mapped_images) {
  // t(x) of constants: 0.1 and 0.4 scaled by 2 are 0.2 and 0.8.
  const auto tone = [](double x) {
    return static_cast<float>((0.9036 * x * x + 0.018 * x) / (0.8748 * x * x + 0.354 * x + 0.14));
  };
  const float dark = tone(0.2), bright = tone(0.8);
  const double expected =
      metric_value("flip", constant_image(20, 20, dark, dark, dark), constant_image(20, 20, bright, bright, bright))
          .value();
  EXPECT_NEAR(hdr_flip(constant_image(20, 20, 0.1f, 0.1f, 0.1f), constant_image(20, 20, 0.4f, 0.4f, 0.4f),
                       ExposureRange{1, 1, 1})
                  .value(),
              expected, 1e-6);
}

TEST(HdrFlip, sees_at_one_exposure_what_another_hides) {
  // 30 against 60 are both white at exposure 0; ten stops down they differ.
  const Image reference = constant_image(12, 12, 30, 30, 30), test = constant_image(12, 12, 60, 60, 60);
  EXPECT_EQ(metric_value("flip", reference, test), 0);
  const double dark = hdr_flip(reference, test, ExposureRange{-6, -6, 1}).value();
  EXPECT_GT(dark, 0.1);
  EXPECT_GE(hdr_flip(reference, test, ExposureRange{-6, 6, 3}).value(), dark);
}

TEST(HdrFlip, takes_the_exact_median_of_the_luminances) {
  // 280 pixels are darker than the grey one and 280 are brighter.
  Image image(51, 11);  // 561 pixels: rank 280 is 280/1000
  for (std::size_t p = 0; p < image.pixels(); ++p)
    for (std::size_t c = 0; c < 3; ++c) image.rgb[3 * p + c] = static_cast<float>((p * 364) % 561) / 1000;
  ImageRowSource rows(image);
  const ExposureRange range = exposures_of(rows).value();
  EXPECT_NEAR(range.stop - range.start, std::log2(0.560 / 0.280), 1e-6);
}

// An object on black: 48 of 400 pixels are (0.9, 0.6, 0.3), and in the test image four of these have half as much.
// NVIDIA's flip-evaluator 1.7 gives 0.0146324522793293. Its exposures are 1.7223823070526123 to 24.083297729492188 in
// 23 steps. By hand: the greatest luminance is 0.2126 * 0.9 + 0.7152 * 0.6 + 0.0722 * 0.3 = 0.64212. The exposed value
// is 2.118872, with log2(2.118872 / 0.64212) = 1.72238 and log2(2.1188723240 * 2^23) = 24.0832966585. The tool's are
// floats, 1.9e-6 apart there.
TEST(HdrFlip, of_an_object_on_black_is_that_of_the_published_tool) {
  Image reference(20, 20), test(20, 20);
  for (int y = 6; y < 12; ++y)
    for (int x = 5; x < 13; ++x)
      for (int c = 0; c < 3; ++c) {
        const bool is_darker = x >= 8 && x < 10 && y >= 8 && y < 10;
        reference.pixel(x, y)[c] = 0.3f * static_cast<float>(3 - c);
        test.pixel(x, y)[c] = (is_darker ? 0.15f : 0.3f) * static_cast<float>(3 - c);
      }
  ImageRowSource rows(reference);
  const ExposureRange range = exposures_of(rows).value();
  EXPECT_NEAR(range.start, 1.7223823, 1e-6);
  EXPECT_NEAR(range.stop, 24.0832966585, 1e-6);
  EXPECT_EQ(range.count, 23);
  EXPECT_NEAR(hdr_flip(reference, test).value(), 0.01463245228, 1e-6);
}

// NVIDIA's tool rejects such images: their first exposure would exceed the last one.
TEST(HdrFlip, of_an_image_darker_than_the_least_median_has_the_exposure_of_its_brightest_pixel) {
  Image image(4, 4);
  for (int c = 0; c < 3; ++c) image.pixel(1, 1)[c] = 1e-9f;
  ImageRowSource rows(image);
  const ExposureRange range = exposures_of(rows).value();
  EXPECT_NEAR(range.start, std::log2(2.118872 / 1e-9), 1e-5);
  EXPECT_EQ(range.stop, range.start);
}

TEST(HdrFlip, is_computed_only_when_asked_for_and_undefined_of_darkness) {
  const Image image = busy_image(12, 12);
  EXPECT_FALSE(metric_value("hdr_flip", image, image));
  EXPECT_EQ(hdr_flip(image, image), 0);
  const Image black = constant_image(12, 12, 0, 0, 0);
  EXPECT_FALSE(hdr_flip(black, image));
  EXPECT_TRUE(hdr_flip(black, image, ExposureRange{-1, 1, 2}));
}

}  // namespace
}  // namespace photonproof::inline harness_metrics
