#include "harness/conclusions/error_split.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "harness/statistics/deviation.h"
#include "harness/statistics/relative_error.h"
#include "harness/statistics/shared_noise.h"
#include "harness/statistics/statistics.h"

namespace photonproof::inline harness_conclusions {
namespace {

constexpr int least_block_side = 4;
constexpr int most_blocks_a_side = 32;  // resampling time is proportional to their number
constexpr double normal_975 = 1.959964;
constexpr double one_sided_tail = 0.025;

// Sums over the channel values of one block of pixels.
struct BlockSums {
  std::vector<double> squared_errors, errors;  ///< of each image: relative squares, and signed, relative to the root
  double bias2 = 0, variance = 0;
  double values = 0;  ///< number of values
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
  for (BlockSums& block : sums) {
    block.squared_errors.resize(images.size());
    block.errors.resize(images.size());
  }
  const auto count = static_cast<double>(images.size());
  for (std::size_t i = 0; i < reference.rgb.size(); ++i) {
    BlockSums& block = sums[blocks.of_pixel(i / 3)];
    const double weight = relative_weight(reference.rgb[i]);
    double total = 0, squares = 0;
    for (std::size_t k = 0; k < images.size(); ++k) {
      const double error = static_cast<double>(images[k].rgb[i]) - static_cast<double>(reference.rgb[i]);
      block.squared_errors[k] += weight * error * error;
      block.errors[k] += std::sqrt(weight) * error;
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
  const auto count = static_cast<double>(images);
  const double half = std::max(normal_975 * std::sqrt(independent_blocks / count),
                               student_975(count - 1) * std::sqrt(sample_variance(totals) / count));
  // The interval is on the logarithm, where an error's distribution is less skewed and the interval stays positive.
  estimate.interval = interval_on_logarithm(estimate.value, half / values / estimate.value);
  return estimate;
}

// Whether the images vary together over more than a block, judged by blocks of 8 x 8 pixels or by the sums of the
// blocks' signed errors. Always true for two images, which do not show it.
bool blocks_share_noise(const std::vector<BlockSums>& blocks, std::span<const Image> images) {
  if (images.size() < 3) return true;
  constexpr double level = 0.01;  // a false alarm only widens intervals
  std::vector<const Image*> pointers;
  for (const Image& image : images) pointers.push_back(&image);
  for (const std::size_t channel : {std::size_t{0}, std::size_t{1}, std::size_t{2}}) {
    const SharedNoise noise = shared_noise(pointers, channel);
    if (noise.is_within_blocks(level) || noise.is_between_blocks(level)) return true;
  }
  std::vector<double> totals(images.size());
  double independent_blocks = 0;
  for (const BlockSums& block : blocks) {
    for (std::size_t k = 0; k < images.size(); ++k) totals[k] += block.errors[k];
    independent_blocks += sample_variance(block.errors);
  }
  const auto freedom = static_cast<double>(images.size() - 1);
  return sample_variance(totals) * freedom > chi_square_bound(freedom, level) * independent_blocks;
}

// Intervals as derived in the header, from estimates without intervals. `own` is the reference's noise.
void set_intervals_of_shared_noise(double own, std::size_t images, ErrorSplit& split) {
  const auto count = static_cast<double>(images);
  const double noise = split.variance->value / count, off = std::sqrt(std::max(0.0, split.bias2->value + noise + own));
  const double h = std::sqrt(std::pow(student_975(count - 1), 2) * noise + own);
  split.bias2->interval = Interval{std::pow(std::max(0.0, off - h), 2), std::pow(off + h, 2)};
  split.variance->interval.reset();
  if (images < 3) return;
  const double freedom = count - 1, squares = split.variance->value * freedom;
  split.variance->interval = Interval{squares / chi_square_bound(freedom, one_sided_tail),
                                      squares / chi_square_bound(freedom, 1 - one_sided_tail)};
}

double share_of_a_pixel(const Image& reference, std::span<const Image> images) {
  double largest = 0, total = 0;
  for (std::size_t i = 0; i < reference.rgb.size(); i += 3) {
    double of_pixel = 0;
    for (std::size_t c = i; c < i + 3; ++c)
      for (const Image& image : images)
        of_pixel += relative_weight(reference.rgb[c]) * std::pow(double{image.rgb[c]} - double{reference.rgb[c]}, 2);
    largest = std::max(largest, of_pixel);
    total += of_pixel;
  }
  return total > 0 ? largest / total : 0;
}

}  // namespace

ErrorSplit split_error(const Image& reference, const Image* reference_variance, std::span<const Image> images,
                       ReferenceVariance known) {
  const std::vector<BlockSums> blocks = sums_of_blocks(reference, reference_variance, images);
  ErrorSplit split{relmse_of_blocks(blocks, images.size()), {}, {}, share_of_a_pixel(reference, images)};
  if (images.size() < 2) return split;
  split.bias2 = resampled(blocks, [](const BlockSums& block) { return block.bias2; });
  split.variance = resampled(blocks, [](const BlockSums& block) { return block.variance; });
  const double own = reference_variance == nullptr ? 0 : relative_variance(reference, *reference_variance);
  if (blocks_share_noise(blocks, images))
    set_intervals_of_shared_noise(own, images.size(), split);
  else if (known == ReferenceVariance::upper_bound && split.bias2->interval)
    split.bias2->interval->high += own;
  if (split.is_of_few_pixels())
    for (Estimate* estimate : {&split.relmse, &*split.bias2, &*split.variance}) estimate->interval.reset();
  return split;
}

double relative_variance(const Image& reference, const Image& reference_variance) {
  double sum = 0;
  for (std::size_t i = 0; i < reference.rgb.size(); ++i)
    sum += relative_weight(reference.rgb[i]) * static_cast<double>(reference_variance.rgb[i]);
  return sum / static_cast<double>(reference.rgb.size());
}

}  // namespace photonproof::inline harness_conclusions
