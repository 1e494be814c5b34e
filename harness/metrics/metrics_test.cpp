#include "harness/metrics/metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <utility>

#include "harness/metrics/metric_run.h"
#include "harness/metrics/test_images.h"
#include "harness/pixels/display.h"
#include "harness/pixels/metric_sum.h"

namespace photonproof::inline harness_metrics {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

double value_of(const std::string& name, const Image& reference, const Image& test, double exposure = 0) {
  return metric_value(name, reference, test, exposure).value();
}

TEST(Metrics, identical_images_have_no_error_at_all) {
  const Image image = busy_image(31, 17, 4);
  for (const MetricValue& metric : compute_metrics(image, image, {}))
    EXPECT_EQ(metric.value, metric.name == "ssim" ? 1 : 0) << metric.name;
}

TEST(Metrics, identical_images_have_infinite_psnr_which_the_record_leaves_out) {
  const Image image = busy_image(31, 17, 4);
  EXPECT_FALSE(metric_value("psnr", image, image));
  for (const Measurement& measured : measure(image, image, {})) {
    if (measured.row->name == std::string("psnr")) {
      EXPECT_EQ(measured.value, std::numeric_limits<double>::infinity());
    }
  }
}

TEST(Metrics, constant_shift_gives_its_closed_form_in_every_linear_metric) {
  // x = r + (1/4, -1/2, 1), exact in floats. mse = (1/16 + 1/4 + 1)/3, mae = (1/4 + 1/2 + 1)/3.
  const Image reference = constant_image(40, 30, 1, 2, 0.5f);
  const Image test = constant_image(40, 30, 1.25f, 1.5f, 1.5f);
  EXPECT_DOUBLE_EQ(value_of("mse", reference, test), 1.3125 / 3);
  EXPECT_DOUBLE_EQ(value_of("rmse", reference, test), std::sqrt(1.3125 / 3));
  EXPECT_DOUBLE_EQ(value_of("mae", reference, test), 1.75 / 3);
  EXPECT_DOUBLE_EQ(value_of("max_abs", reference, test), 1);
  // mean(x-r) = (1/4 - 1/2 + 1)/3 = 0.25 of mean(r) = 3.5/3.
  EXPECT_DOUBLE_EQ(value_of("bias", reference, test), 0.75 / 3.5);
  EXPECT_DOUBLE_EQ(value_of("bias_r", reference, test), 0.25);
  EXPECT_DOUBLE_EQ(value_of("bias_g", reference, test), -0.25);
  EXPECT_DOUBLE_EQ(value_of("bias_b", reference, test), 2);
  // (1/16)/(1 + .01), (1/4)/(4 + .01), 1/(1/4 + .01), and their mean.
  const double relative = (0.0625 / 1.01 + 0.25 / 4.01 + 1 / 0.26) / 3;
  EXPECT_NEAR(value_of("relmse", reference, test), relative, 1e-12);  // 1200 roundings of 1e-16
  EXPECT_NEAR(value_of("relmse_trimmed", reference, test), relative, 1e-12);
}

/// An image of one 8-bit grey level, as a file of 8 bits is read.
Image grey_level(int width, int height, int level) {
  const auto value = static_cast<float>(decode_srgb(level / 255.0));
  return constant_image(width, height, value, value, value);
}

double differing(const std::string& name, const Image& reference, const Image& test, double more_than,
                 std::shared_ptr<const PixelMask> mask = nullptr) {
  MetricOptions options;
  options.parameters.more_than = more_than;
  options.only = {name};
  options.mask = std::move(mask);
  return compute_metrics(reference, test, options).at(0).value;
}

TEST(Metrics, differing_counts_the_pixels_whose_worst_channel_is_off_by_more) {
  // 15 x 10 pixels of level 100. Three are off by 1, two by 6 levels in one channel each: 2 of 150 by more than 1.
  const Image reference = grey_level(15, 10, 100);
  Image test = reference;
  for (int x = 0; x < 3; ++x) test.pixel(x, 4)[0] = static_cast<float>(decode_srgb(101 / 255.0));
  test.pixel(7, 7)[1] = static_cast<float>(decode_srgb(94 / 255.0));
  test.pixel(14, 9)[2] = static_cast<float>(decode_srgb(106 / 255.0));
  EXPECT_EQ(differing("differing_pixels", reference, test, 1 / 255.0), 2);
  EXPECT_DOUBLE_EQ(differing("differing", reference, test, 1 / 255.0), 2 / 150.0);
  EXPECT_EQ(differing("differing_pixels", reference, test, 0), 5);
  EXPECT_EQ(differing("differing_pixels", reference, test, 6 / 255.0), 0);
  EXPECT_EQ(differing("differing_pixels", reference, test, 5.9 / 255.0), 2);
  auto mask = std::make_shared<PixelMask>(15, 10);
  for (int x = 0; x < 15; ++x) mask->set(x, 7);
  EXPECT_DOUBLE_EQ(differing("differing", reference, test, 1 / 255.0, mask), 1 / 15.0);
}

// Both are clamped to white: the display shows no difference. Two stops darker, values are 1/2 and 1.
TEST(Metrics, differing_compares_displayed_values_at_the_exposure) {
  const Image reference = constant_image(4, 4, 2, 2, 2), test = constant_image(4, 4, 4, 4, 4);
  MetricOptions options;
  options.only = {"differing"};
  EXPECT_EQ(compute_metrics(reference, test, options).at(0).value, 0);
  options.parameters.exposure = -2;
  options.parameters.more_than = 1 - encode_srgb(0.5) - 0.01;
  EXPECT_EQ(compute_metrics(reference, test, options).at(0).value, 1);
  options.parameters.more_than += 0.02;
  EXPECT_EQ(compute_metrics(reference, test, options).at(0).value, 0);
}

TEST(Metrics, one_wrong_pixel_counts_by_its_share_of_the_image) {
  // One channel value of 50 * 40 * 3 is off by 1/2 from 1: mse = 0.25/6000, relmse = (0.25/1.01)/6000.
  const Image reference = constant_image(50, 40, 1, 1, 1);
  Image test = reference;
  test.pixel(12, 34)[1] = 1.5f;
  EXPECT_DOUBLE_EQ(value_of("mse", reference, test), 0.25 / 6000);
  EXPECT_DOUBLE_EQ(value_of("mae", reference, test), 0.5 / 6000);
  EXPECT_EQ(value_of("max_abs", reference, test), 0.5);
  EXPECT_DOUBLE_EQ(value_of("relmse", reference, test), 0.25 / 1.01 / 6000);
}

TEST(Metrics, relative_metrics_of_other_tools_have_their_own_denominators) {
  // x = 1.5 against r = 0.5 in every value: (x-r)^2 = 1, |x-r| = 1.
  const Image reference = constant_image(12, 12, 0.5f, 0.5f, 0.5f), test = constant_image(12, 12, 1.5f, 1.5f, 1.5f);
  EXPECT_NEAR(value_of("relmse_jeri", reference, test), 1 / (0.25 + 1e-4), 1e-12);
  EXPECT_NEAR(value_of("mrse_pbrt", reference, test), 1 / (0.51 * 0.51), 1e-12);
  EXPECT_NEAR(value_of("smape", reference, test), 2 / (1.5 + 0.5 + 0.02), 1e-12);
  // Signs: |x| + |r| of -0.5 and 1.5 is the same 2, but the values are 2 apart.
  const Image negative = constant_image(12, 12, -0.5f, -0.5f, -0.5f);
  EXPECT_NEAR(value_of("smape", negative, test), 4 / 2.02, 1e-12);
}

TEST(Metrics, relmse_trimmed_leaves_out_one_pixel_in_a_thousand) {
  // Two of 2000 pixels may be left out. Three are off by 1, 2 and 3 in all channels of r = 1. The rest is the least,
  // 1/1.01 over the 1998 that stay.
  const Image reference = constant_image(50, 40, 1, 1, 1);
  Image test = reference;
  for (int i = 1; i <= 3; ++i)
    for (int c = 0; c < 3; ++c) test.pixel(7 * i, 9 * i)[c] += static_cast<float>(i);
  EXPECT_DOUBLE_EQ(value_of("relmse_trimmed", reference, test), 1 / 1.01 / 1998);
  EXPECT_DOUBLE_EQ(value_of("relmse", reference, test), 14 / 1.01 / 2000);
}

TEST(Metrics, relmse_trimmed_leaves_out_no_more_and_no_fewer) {
  // 40 of 40 000 pixels may be left out; 41 are wrong, one of them by less. A fraction 5 % too small would leave 39.
  const Image reference = constant_image(200, 200, 1, 1, 1);
  Image test = reference;
  for (int i = 0; i < 41; ++i)
    for (int c = 0; c < 3; ++c) test.pixel(4 * i, 3 * i)[c] += i == 20 ? 1.0f : 2.0f;
  EXPECT_DOUBLE_EQ(value_of("relmse_trimmed", reference, test), 1 / 1.01 / 39960);
  // With 40 wrong ones no error remains.
  for (int c = 0; c < 3; ++c) test.pixel(80, 60)[c] = 1;
  EXPECT_EQ(value_of("relmse_trimmed", reference, test), 0);
  for (int c = 0; c < 3; ++c) test.pixel(3, 199)[c] = test.pixel(4, 199)[c] = 1.5f;
  EXPECT_DOUBLE_EQ(value_of("relmse_trimmed", reference, test), 0.5 / 1.01 / 39960);
}

TEST(Metrics, relmse_trimmed_counts_equal_errors_at_the_limit_as_often_as_they_stay) {
  // Every pixel has the same error, so leaving out two of 2000 changes nothing.
  const Image reference = constant_image(50, 40, 1, 1, 1);
  const Image test = constant_image(50, 40, 2, 2, 2);
  EXPECT_DOUBLE_EQ(value_of("relmse_trimmed", reference, test), 1 / 1.01);
}

TEST(Metrics, image_under_a_thousand_pixels_has_nothing_to_trim) {
  const Image reference = busy_image(37, 27);  // 999
  const Image test = busy_image(37, 27, 1, 2);
  EXPECT_DOUBLE_EQ(value_of("relmse_trimmed", reference, test), value_of("relmse", reference, test));
}

TEST(Metrics, relmse_map_averages_to_relmse) {
  const Image reference = busy_image(23, 19, 3);
  const Image test = busy_image(23, 19, 3, 2);
  const std::vector<float> map = relmse_map(reference, test);
  ASSERT_EQ(map.size(), reference.pixels());
  const double sum = lane_sum(map.size(), [&](std::size_t i) { return static_cast<double>(map[i]); });
  const double mean = sum / static_cast<double>(map.size());
  EXPECT_NEAR(mean, value_of("relmse", reference, test), 1e-6 * mean);  // the map is rounded to float
}

TEST(Metrics, bias_is_undefined_against_black) {
  const Image black = constant_image(12, 12, 0, 0, 1);
  const Image test = constant_image(12, 12, 1, 1, 1);
  EXPECT_FALSE(metric_value("bias_r", black, test));
  EXPECT_FALSE(metric_value("bias_g", black, test));
  EXPECT_EQ(metric_value("bias_b", black, test), 0);
  EXPECT_EQ(metric_value("bias", black, test), 2);  // mean(x-r) = 2/3, mean(r) = 1/3
}

TEST(Metrics, psnr_is_that_of_the_encoded_difference) {
  // 2^-1 * 0.5 = 1/4 encodes to 1.055 * (1/4)^(1/2.4) - 0.055; black encodes to 0.
  const double encoded = 1.055 * std::pow(0.25, 1 / 2.4) - 0.055;
  const Image reference = constant_image(12, 12, 0, 0, 0);
  const Image test = constant_image(12, 12, 0.5f, 0.5f, 0.5f);
  EXPECT_NEAR(value_of("psnr", reference, test, -1), -20 * std::log10(encoded), 1e-12);
}

TEST(Metrics, displayed_metrics_see_no_difference_beyond_white_but_linear_ones_do) {
  const Image reference = constant_image(12, 12, 2, 2, 2);
  const Image test = constant_image(12, 12, 3, 3, 3);
  EXPECT_FALSE(metric_value("psnr", reference, test));
  EXPECT_EQ(value_of("ssim", reference, test), 1);
  EXPECT_EQ(value_of("flip", reference, test), 0);
  EXPECT_EQ(value_of("mse", reference, test), 1);
  EXPECT_GT(value_of("flip", reference, test, -2), 0.01);  // 1/2 against 3/4
}

TEST(Metrics, parameters_travel_with_the_numbers) {
  const Image reference = busy_image(161, 161);  // the smallest size at which every metric has a value
  const Image test = busy_image(161, 161, 1, 2);
  std::map<std::string, std::string> parameters;
  const MetricOptions options{
      .parameters = {.exposure = -1.5, .hdr_exposures = ExposureRange{-2, 1.5, 3}, .more_than = 0.02},
      .also = {"hdr_flip", "differing", "differing_pixels"}};
  for (const MetricValue& metric : compute_metrics(reference, test, options))
    parameters[metric.name] = metric.parameters;
  EXPECT_EQ(parameters.size(), metric_rows().size());
  EXPECT_EQ(parameters["mse"], "");
  EXPECT_EQ(parameters["relmse"], "epsilon=0.01");
  EXPECT_EQ(parameters["relmse_trimmed"], "epsilon=0.01, trimmed=0.1% of pixels");
  EXPECT_EQ(parameters["psnr"], "exposure=-1.5, peak=1");
  EXPECT_EQ(parameters["ssim"], "exposure=-1.5, window=11, sigma=1.5, K1=0.01, K2=0.03, data_range=1");
  EXPECT_EQ(parameters["relmse_jeri"], "epsilon=0.0001");
  EXPECT_EQ(parameters["mrse_pbrt"], "epsilon=0.01");
  EXPECT_EQ(parameters["smape"], "epsilon=0.02");
  EXPECT_EQ(parameters["ms_ssim"], parameters["ssim"] + ", scales=5, weights=0.0448 0.2856 0.3001 0.2363 0.1333");
  EXPECT_EQ(parameters["flip"], "exposure=-1.5, pixels_per_degree=67.0206");
  EXPECT_EQ(parameters["differing"], "exposure=-1.5, more_than=0.02");
  EXPECT_EQ(parameters["differing_pixels"], parameters["differing"]);
  EXPECT_EQ(parameters["hdr_flip"], "tone_mapper=ACES, exposures=-2 1.5 3, pixels_per_degree=67.0206");
}

std::map<std::string, Measurement> every_metric(const ParameterValues& values) {
  // The smallest images for which every metric has a value.
  MetricOptions options{.parameters = values};
  for (const MetricRow& row : metric_rows()) options.also.emplace_back(row.name);
  std::map<std::string, Measurement> all;
  for (Measurement& measured : measure(busy_image(161, 161), busy_image(161, 161, 1, 2), options))
    all[measured.row->name] = std::move(measured);
  return all;
}

TEST(MetricParameters, another_value_changes_the_numbers_and_the_print_of_those_that_have_it_and_of_no_other) {
  const auto before = every_metric({});
  ASSERT_EQ(before.size(), metric_rows().size());
  for (const MetricParameter& parameter : metric_parameters) {
    ParameterValues values;
    ASSERT_EQ(set_parameter(parameter, example_of(parameter), values), std::nullopt) << parameter.name;
    const std::string printed = std::string(parameter.name) + "=" + value_text(parameter, values);
    EXPECT_NE(metrics_with(parameter), "") << parameter.name;
    for (const auto& [name, after] : every_metric(values)) {
      const bool has = has_parameter(*after.row, parameter);
      EXPECT_EQ(after.value != before.at(name).value, has) << name << " " << parameter.name;
      EXPECT_EQ((", " + after.parameters + ",").find(", " + printed + ",") != std::string::npos, has)
          << name << ": " << after.parameters;
    }
  }
}

TEST(MetricParameters, every_name_that_a_metric_prints_has_a_value) {
  for (const auto& [name, measured] : every_metric({})) {
    const std::string& text = measured.parameters;
    for (std::size_t at = 0; at < text.size(); at = std::min(text.find(", ", at), text.size() - 2) + 2)
      EXPECT_NE(text.substr(at, text.find(", ", at) - at).find('='), std::string::npos) << name << ": " << text;
  }
}

TEST(MetricParameters, what_is_out_of_range_is_said_and_not_set) {
  const MetricParameter &number = metric_parameters[0], &range = metric_parameters[1];
  ParameterValues values{.exposure = 3, .hdr_exposures = ExposureRange{1, 2, 5}};
  const auto problem = [&](const MetricParameter& parameter, const std::vector<double>& numbers) {
    return set_parameter(parameter, numbers, values).value_or("none");
  };
  EXPECT_EQ(problem(number, {64.5}), "64.5 is not from -64 to 64");
  EXPECT_EQ(problem(number, {std::nan("")}).substr(4), "is not from -64 to 64");
  EXPECT_EQ(problem(number, {1, 2}), "expected a number");
  for (const std::vector<double>& numbers :
       {std::vector<double>{-2, 1}, {1, -2, 4}, {-65, 1, 4}, {-2, 1, 0}, {-2, 1, 101}, {-2, 1, 1e12}})
    EXPECT_EQ(problem(range, numbers), expected_exposures);
  EXPECT_EQ(problem(range, {-2, 1, 2.5}), "the count 2.5 is not a whole number");
  EXPECT_EQ(value_text(number, values) + ", " + value_text(range, values), "3, 1 2 5");
  EXPECT_EQ(problem(number, {-64}), "none");
  EXPECT_EQ(problem(range, {-64, 64, 100}), "none");
  EXPECT_EQ(values_text(values).rfind("exposure=-64, exposures=-64 64 100", 0), 0u);
  EXPECT_EQ(value_text(range, {}), "");
  EXPECT_EQ(values_text({}).find("exposures"), std::string::npos);
}

TEST(MetricParameters, those_that_are_given_stand_in_for_others) {
  const ParameterValues scene{.exposure = 3, .hdr_exposures = ExposureRange{1, 2, 5}};
  EXPECT_EQ(values_text(with_given(scene, {})), values_text(scene));
  const std::vector<GivenParameter> given = {{&metric_parameters[0], {-0.25}}};
  const ParameterValues values = with_given(scene, given);
  EXPECT_EQ(values.exposure, -0.25);
  EXPECT_EQ(values.hdr_exposures, scene.hdr_exposures);
  EXPECT_EQ(given_text(given), "exposure=-0.25");
}

TEST(Metrics, a_metric_on_request_is_computed_where_it_is_named_and_else_left_out) {
  const Image image = busy_image(12, 12), other = busy_image(12, 12, 1, 2);
  const auto names = [&](const MetricOptions& options) {
    std::vector<std::string> found;
    for (const MetricValue& metric : compute_metrics(image, other, options)) found.push_back(metric.name);
    return found;
  };
  int on_request = 0;
  for (const MetricRow& row : metric_rows()) {
    if (!row.on_request) continue;
    ++on_request;
    EXPECT_EQ(std::ranges::count(names({}), row.name), 0) << row.name;
    EXPECT_EQ(std::ranges::count(names({.also = {row.name}}), row.name), 1) << row.name;
    EXPECT_EQ(names({.only = {row.name}}), std::vector<std::string>{row.name});  // its parameters are derived here, too
    EXPECT_EQ(names({.only = {"mse"}, .also = {row.name}}), (std::vector<std::string>{"mse", row.name}));
  }
  EXPECT_GT(on_request, 0);
}

TEST(Metrics, values_of_extreme_magnitude_stay_finite) {
  const float greatest = std::numeric_limits<float>::max();
  const Image reference = constant_image(12, 12, 0, 0, 1e-45f);
  const Image test = constant_image(12, 12, greatest, -greatest, greatest);
  for (const Measurement& measured : measure(reference, test, {.parameters = {.exposure = 60}})) {
    if (measured.value) {
      EXPECT_TRUE(std::isfinite(*measured.value)) << measured.row->name;
    }
  }
}

TEST(Metrics, defects_name_the_first_value_that_is_not_finite_and_count_them) {
  Image reference = constant_image(20, 50, 1, 1, 1);
  Image test = reference;
  EXPECT_TRUE(find_defects(reference, test).empty());

  test.pixel(12, 40)[1] = kNaN;
  test.pixel(13, 40)[0] = kInfinity;
  test.pixel(2, 41)[2] = kNaN;
  auto defects = find_defects(reference, test);
  ASSERT_EQ(defects.size(), 1u);
  EXPECT_EQ(defects[0].kind, ImageDefect::Kind::non_finite);
  EXPECT_EQ(defects[0].sentence, "pixel (12, 40) of the test image is NaN in G; 3 non-finite in all");

  reference.pixel(0, 0)[0] = -kInfinity;
  defects = find_defects(reference, test);
  ASSERT_EQ(defects.size(), 2u);
  EXPECT_EQ(defects[0].sentence, "pixel (0, 0) of the reference image is -infinity in R; 1 non-finite in all");
}

TEST(Metrics, defects_name_both_sizes) {
  const auto defects = find_defects(Image(20, 50), Image(50, 20));
  ASSERT_EQ(defects.size(), 1u);
  EXPECT_EQ(defects[0].kind, ImageDefect::Kind::size_mismatch);
  EXPECT_EQ(defects[0].sentence, "the test image is 50x20 pixels, the reference image 20x50");
}

TEST(Metrics, images_without_pixels_are_a_defect) {
  const auto defects = find_defects(Image(), Image());
  ASSERT_EQ(defects.size(), 1u);
  EXPECT_EQ(defects[0].sentence, "the images have no pixels");
}

TEST(MetricSum, long_sums_lose_no_more_than_short_ones) {
  // Three million values off by 0.1. Added one after the other, the mean's error is about 5e-12. Added a tile at a
  // time, in eight lanes, it stays near that of 49 152 / 8 additions, of which 3 roundings of 1e-16 show.
  const Image reference = constant_image(1000, 1000, 0, 0, 0);
  const Image test = constant_image(1000, 1000, 0.1f, 0.1f, 0.1f);
  EXPECT_NEAR(value_of("mae", reference, test), static_cast<double>(0.1f), 1e-13);
}

TEST(MetricSum, exact_sum_keeps_what_a_plain_one_rounds_away) {
  // 1e16 + 1 is 1e16 in doubles; ten thousand times 1 must not be lost.
  ExactSum sum;
  sum.add(1e16);
  for (int i = 0; i < 10000; ++i) sum.add(1);
  EXPECT_EQ(sum.value(), 1e16 + 10000);
}

}  // namespace
}  // namespace photonproof::inline harness_metrics
