#include "harness/metric_filter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace photonproof {
namespace {

Plane ramp(int width, int height) {
  Plane plane(width, height);
  std::iota(plane.values.begin(), plane.values.end(), 1.0);
  return plane;
}

TEST(MetricFilter, gaussian_sums_to_one_and_is_symmetric) {
  const Kernel kernel = gaussian_kernel(1.5, 5);
  ASSERT_EQ(kernel.size(), 11u);
  EXPECT_NEAR(std::accumulate(kernel.begin(), kernel.end(), 0.0), 1, 1e-15);
  for (std::size_t k = 0; k < 5; ++k) EXPECT_EQ(kernel[k], kernel[10 - k]);
}

TEST(MetricFilter, rows_and_columns_repeat_the_border_value) {
  // Weights (100, 10, 1) read off left, middle and right (above, middle, below) neighbours as decimal digits.
  const Kernel digits = {100, 10, 1};
  const Plane plane = ramp(3, 2);  // 1 2 3 / 4 5 6
  EXPECT_EQ(filter_rows(plane, digits).values, (std::vector<double>{112, 123, 233, 445, 456, 566}));
  EXPECT_EQ(filter_columns(plane, digits).values, (std::vector<double>{114, 225, 336, 144, 255, 366}));
}

TEST(MetricFilter, kernel_may_be_wider_than_the_plane) {
  const Plane plane = ramp(2, 1);  // 1 2
  const Kernel ones(7, 1.0);
  EXPECT_EQ(filter_rows(plane, ones).values, (std::vector<double>{4 * 1 + 3 * 2, 3 * 1 + 4 * 2}));
  EXPECT_EQ(filter_columns(plane, ones).values, (std::vector<double>{7, 14}));
}

}  // namespace
}  // namespace photonproof
