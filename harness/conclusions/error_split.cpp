#include "harness/conclusions/error_split.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "harness/statistics/relative_error.h"
#include "harness/statistics/statistics.h"

namespace photonproof {
namespace {

constexpr int least_block_side = 4;
constexpr int most_blocks_a_side = 32;  // resampling takes time in proportion to their number
constexpr double normal_975 = 1.959964;

// Sums over the channel values of one block of pixels.
struct BlockSums {
  std::vector<double> squared_errors;  ///< of each image
  double bias2 = 0, variance = 0;
  double values = 0;  ///< how many
};

class Blocks {
 public:
  Blocks(int width, int height) : width_(width) {
    side_ = std::max(least_block_side, (std::max(width, height) + most_blocks_a_side - 1) / most_blocks_a_side);
    columns_ = (width + side_ - 1) / side_;
    count_ = static_cast<std::size_t>(columns_ * ((height + side_ - 1) / side_));
  }
  std::size_t count() const { return count_; }
  std::size_t of_pixel(std::size_t pixel) const {
    const int x = static_cast<int>(pixel % static_cast<std::size_t>(width_));
    const int y = static_cast<int>(pixel / static_cast<std::size_t>(width_));
    return static_cast<std::size_t>(y / side_ * columns_ + x / side_);
  }

 private:
  int width_, side_ = 0, columns_ = 0;
  std::size_t count_ = 0;
};

std::vector<BlockSums> sums_of_blocks(const Image& reference, const Image* reference_variance,
                                      std::span<const Image> images) {
  const Blocks blocks(reference.width, reference.height);
  std::vector<BlockSums> sums(blocks.count());
  for (BlockSums& block : sums) block.squared_errors.resize(images.size());
  const auto count = static_cast<double>(images.size());
  for (std::size_t i = 0; i < reference.rgb.size(); ++i) {
    BlockSums& block = sums[blocks.of_pixel(i / 3)];
    const double weight = relative_weight(reference.rgb[i]);
    double total = 0, squares = 0;
    for (std::size_t k = 0; k < images.size(); ++k) {
      const double error = static_cast<double>(images[k].rgb[i]) - static_cast<double>(reference.rgb[i]);
      block.squared_errors[k] += weight * error * error;
      total += error;
      squares += error * error;
    }
    block.values += 1;
    if (images.size() < 2) continue;
    const double mean = total / count;
    const double variance = std::max(0.0, squares - count * mean * mean) / (count - 1);
    const double own = reference_variance == nullptr ? 0 : static_cast<double>(reference_variance->rgb[i]);
    block.variance += weight * variance;
    block.bias2 += weight * (mean * mean - variance / count - own);
  }
  return sums;
}

// A sum over blocks divided by the number of values in them, with its interval.
template <class Sum>
Estimate resampled(const std::vector<BlockSums>& blocks, const Sum& sum) {
  const IndexStatistic mean = [&](std::span<const std::size_t> indices) {
    double total = 0, values = 0;
    for (const std::size_t b : indices) {
      total += sum(blocks[b]);
      values += blocks[b].values;
    }
    return total / values;
  };
  std::vector<std::size_t> all(blocks.size());
  for (std::size_t b = 0; b < all.size(); ++b) all[b] = b;
  Estimate estimate{mean(all), {}};
  if (blocks.size() > 1) estimate.interval = bootstrap_bca(blocks.size(), mean);
  return estimate;
}

double sample_variance(std::span<const double> values) {
  const double mean = mean_of(values);
  double squares = 0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return squares / static_cast<double>(values.size() - 1);
}

Estimate relmse_of_blocks(const std::vector<BlockSums>& blocks, std::size_t images) {
  std::vector<double> totals(images);
  double values = 0, independent_blocks = 0;
  for (const BlockSums& block : blocks) {
    values += block.values;
    for (std::size_t k = 0; k < images; ++k) totals[k] += block.squared_errors[k];
    if (images > 1) independent_blocks += sample_variance(block.squared_errors);
  }
  Estimate estimate{mean_of(totals) / values, {}};
  if (images < 2 || estimate.value <= 0) return estimate;
  const double variance = std::max(independent_blocks, sample_variance(totals)) / static_cast<double>(images);
  // On the logarithm, where an error's distribution is less skewed and its interval stays positive.
  const double half = normal_975 * std::sqrt(variance) / values / estimate.value;
  estimate.interval = Interval{estimate.value * std::exp(-half), estimate.value * std::exp(half)};
  return estimate;
}

}  // namespace

ErrorSplit split_error(const Image& reference, const Image* reference_variance, std::span<const Image> images,
                       ReferenceVariance known) {
  const std::vector<BlockSums> blocks = sums_of_blocks(reference, reference_variance, images);
  ErrorSplit split{relmse_of_blocks(blocks, images.size()), {}, {}};
  if (images.size() < 2) return split;
  split.bias2 = resampled(blocks, [](const BlockSums& block) { return block.bias2; });
  if (known == ReferenceVariance::upper_bound && reference_variance != nullptr && split.bias2->interval)
    split.bias2->interval->high += relative_variance(reference, *reference_variance);
  split.variance = resampled(blocks, [](const BlockSums& block) { return block.variance; });
  return split;
}

double relative_variance(const Image& reference, const Image& reference_variance) {
  double sum = 0;
  for (std::size_t i = 0; i < reference.rgb.size(); ++i)
    sum += relative_weight(reference.rgb[i]) * static_cast<double>(reference_variance.rgb[i]);
  return sum / static_cast<double>(reference.rgb.size());
}

}  // namespace photonproof
