// The variance of a block of pixels, and its degrees of freedom.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "harness/pixels/image_blocks.h"
#include "harness/statistics/deviation.h"

namespace photonproof::inline harness_statistics {

/// The variance of a sum over a block whose pixels are independent. The spread of the pixels' variances gives its
/// degrees of freedom. `value(x, y)` is a pixel's variance.
template <class Value>
KnownVariance known_over(const Block& block, const Value& value) {
  KnownVariance known;
  for_each_pixel(block, [&](int x, int y) { known.variance += value(x, y); });
  const double mean = known.variance / block.pixels();
  double spread = 0;
  for_each_pixel(block, [&](int x, int y) { spread += std::pow(value(x, y) - mean, 2); });
  const double unbiased = spread * block.pixels() / std::max(1.0, block.pixels() - 1);
  if (unbiased > 0) known.freedom = 2 * known.variance * known.variance / unbiased;
  return known;
}

/// Squared relative deviation of the block's variances. It uses their median and median absolute deviation, so that an
/// edge or a light in the block does not count.
template <class Value>
double relative_spread_of_variance(const Block& block, const Value& value) {
  std::vector<double> values;
  for_each_pixel(block, [&](int x, int y) { values.push_back(value(x, y)); });
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  const double median = *middle;
  for (double& v : values) v = std::abs(v - median);
  std::nth_element(values.begin(), middle, values.end());
  constexpr double of_normal = 1.4826;  // deviation over median absolute deviation
  return median > 0 ? std::pow(of_normal * *middle / median, 2) : 0;
}

}  // namespace photonproof::inline harness_statistics
