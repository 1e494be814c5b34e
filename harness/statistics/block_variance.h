// The variance of a block of pixels, and how well it is known.
#pragma once

#include <algorithm>
#include <cmath>

#include "harness/pixels/image_blocks.h"
#include "harness/statistics/deviation.h"

namespace photonproof {

/// The variance of a sum over a block whose pixels are independent, known as well as their spread says. `value(x, y)`
/// is a pixel's variance.
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

}  // namespace photonproof
