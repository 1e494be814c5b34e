#include "harness/metrics/metric_flip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "harness/metrics/test_images.h"
#include "harness/metrics/test_oracle_table.h"

namespace photonproof::inline harness_metrics {
namespace {

TEST(Flip, agrees_with_the_independent_implementation) {
  const auto pairs = read_oracle_table("flip_expected.csv");
  ASSERT_EQ(pairs.size(), 4u);
  for (const OraclePair& pair : pairs) {
    ASSERT_EQ(pair.expected.size(), 5u);
    for (const auto& [name, expected] : pair.expected)
      EXPECT_NEAR(metric_value(name, pair.reference, pair.test, pair.exposure).value(), expected, 1e-6)
          << pair.name << " " << name;
  }
}

TEST(Flip, of_black_and_white_is_the_mapped_lightness_difference) {
  // Flat images pass every filter unchanged and have no features. Only L* differs, by 100: HyAB = 100. The greatest
  // distance is 203.30165 (green L* 87.7, blue 32.3 by the sRGB matrix). Both ^0.7 are 25.1189 against 0.4 * 41.2760 =
  // 16.5104 at the knee, giving 0.95 + 0.05 * (25.1189 - 16.5104) / (41.2760 - 16.5104).
  const double greatest = std::pow(203.30165461, 0.7);
  const double expected = 0.95 + 0.05 * (std::pow(100, 0.7) - 0.4 * greatest) / (0.6 * greatest);
  const Image black = constant_image(20, 20, 0, 0, 0);
  const Image white = constant_image(20, 20, 1, 1, 1);
  for (const float error : flip_map(black, white, {})) EXPECT_NEAR(error, expected, 1e-6);
}

TEST(Flip, of_green_and_blue_is_one) {
  // The pair that defines the end of the scale.
  const Image green = constant_image(20, 20, 0, 1, 0);
  const Image blue = constant_image(20, 20, 0, 0, 1);
  for (const float error : flip_map(green, blue, {})) EXPECT_NEAR(error, 1, 1e-6);
}

TEST(Flip, does_not_depend_on_the_order_of_the_images) {
  const Image a = busy_image(33, 21, 2);
  const Image b = busy_image(33, 21, 2, 2);
  EXPECT_EQ(flip_map(a, b, {}), flip_map(b, a, {}));
}

TEST(Flip, stays_in_zero_to_one_on_extreme_patterns) {
  Image a(40, 40);
  Image b(40, 40);
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 40; ++x)
      for (int c = 0; c < 3; ++c) {
        a.pixel(x, y)[c] = (x / 10 + y / 10 + c) % 2 ? 1.0f : 0.0f;
        b.pixel(x, y)[c] = 1 - a.pixel(x, y)[c];
      }
  for (const float error : flip_map(a, b, {})) {
    EXPECT_GE(error, 0);
    EXPECT_LE(error, 1);
  }
}

TEST(Flip, of_a_shift_by_one_pixel_is_where_the_edge_is) {
  // A step between columns 29 and 30 against one between 30 and 31. The filters reach 10 pixels, so the map is 0 beyond
  // columns 30 +- 11. Like the images it is the same in every row, and it is largest beside the step.
  Image reference(60, 12);
  Image test(60, 12);
  for (int y = 0; y < 12; ++y)
    for (int x = 0; x < 60; ++x)
      for (int c = 0; c < 3; ++c) {
        reference.pixel(x, y)[c] = x < 30 ? 0.1f : 0.8f;
        test.pixel(x, y)[c] = x < 31 ? 0.1f : 0.8f;
      }
  const std::vector<float> map = flip_map(reference, test, {});
  for (std::size_t y = 0; y < 12; ++y)
    for (std::size_t x = 0; x < 60; ++x) {
      EXPECT_NEAR(map[60 * y + x], map[x], 1e-6) << x << " " << y;
      if (x < 19 || x > 41) {
        EXPECT_LT(map[60 * y + x], 1e-6) << x;
      }
    }
  const auto greatest = std::max_element(map.begin(), map.begin() + 60) - map.begin();
  EXPECT_GE(greatest, 28);
  EXPECT_LE(greatest, 32);
  EXPECT_GT(map[30], 0.1);
}

TEST(Flip, pooled_values_weigh_an_error_by_its_size) {
  // Three flat regions would blur into each other, so the map itself gives the order statistics.
  const Image reference = busy_image(24, 18);
  const Image test = busy_image(24, 18, 1, 2);
  std::vector<float> sorted = flip_map(reference, test, {});
  std::sort(sorted.begin(), sorted.end());
  const double total = std::accumulate(sorted.begin(), sorted.end(), 0.0);
  const auto sum_below = [&](double limit) {
    double sum = 0;
    for (const float error : sorted)
      if (error < limit) sum += error;
    return sum;
  };
  for (const auto& [name, fraction] :
       {std::pair{"flip_weighted_quartile1", 0.25}, {"flip_weighted_median", 0.5}, {"flip_weighted_quartile3", 0.75}}) {
    const double value = metric_value(name, reference, test).value();
    EXPECT_LE(sum_below(value), fraction * total) << name;  // smaller values do not pass the fraction
    EXPECT_GT(sum_below(std::nextafter(value, 2)), fraction * total) << name;  // with this value the sum does
  }
  EXPECT_EQ(metric_value("flip_max", reference, test), sorted.back());
}

// Steps are whole multiples of 2^-22, so sums of the map's values are exact and the pool must give the same bits.
TEST(Flip, pools_of_listed_and_of_counted_steps_are_those_of_the_map) {
  for (const int width : {128, 257}) {
    const int height = 128;
    ASSERT_EQ(static_cast<std::uint64_t>(width) * height <= FlipPool::most_listed, width == 128);
    const Image reference = busy_image(width, height), test = busy_image(width, height, 1, 2);
    std::vector<float> sorted = flip_map(reference, test, {});
    std::sort(sorted.begin(), sorted.end());
    const double total = std::accumulate(sorted.begin(), sorted.end(), 0.0);
    EXPECT_EQ(metric_value("flip", reference, test), total / (width * height)) << width;
    EXPECT_EQ(metric_value("flip_max", reference, test), sorted.back()) << width;
    const char* names[] = {"flip_weighted_quartile1", "flip_weighted_median", "flip_weighted_quartile3"};
    for (int i = 0; i < 3; ++i) {
      double running = 0;
      const auto passes = [&](float error) { return (running += error) > 0.25 * (i + 1) * total; };
      EXPECT_EQ(metric_value(names[i], reference, test), *std::ranges::find_if(sorted, passes)) << width << names[i];
    }
  }
}

TEST(Flip, uses_the_viewing_distance_of_nvidias_tool) {
  // 0.7 m from a monitor 0.7 m and 3840 pixels wide: a degree is 0.7 pi/180 m of it.
  EXPECT_DOUBLE_EQ(flip_pixels_per_degree, 0.7 * (3840 / 0.7) * std::numbers::pi / 180);
}

}  // namespace
}  // namespace photonproof::inline harness_metrics
