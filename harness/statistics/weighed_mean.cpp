#include "harness/statistics/weighed_mean.h"

#include <algorithm>
#include <cmath>

#include "harness/statistics/block_variance.h"
#include "harness/statistics/picture_noise.h"
#include "scenes/images/mean_error.h"

namespace photonproof::inline harness_statistics {
namespace {

constexpr double kMostOfMedian = 4;  // largest weight of a place in the whole image's mean, over the median one's

}  // namespace

PixelWeights::PixelWeights(const Rendering& reference, const Rendering& test, std::size_t channel)
    : width_(reference.mean.width), across_((width_ + block_side - 1) / block_side) {
  const std::vector<Block> blocks = blocks_of(width_, reference.mean.height);
  std::array<std::vector<double>, 2> means, variances;  // sums over a block's pixels of either colour
  for (const Block& block : blocks) {
    std::array<double, 2> mean{}, variance{};
    for_each_pixel(block, [&](int x, int y) {
      const double r = double{reference.mean.pixel(x, y)[channel]}, t = double{test.mean.pixel(x, y)[channel]};
      const std::size_t c = colour(x, y);
      mean[c] += std::abs(r + t) / 2;
      variance[c] += double{reference.variance->pixel(x, y)[channel]} + double{test.variance->pixel(x, y)[channel]} +
                     std::pow(rounding_deviation * (r + t), 2);
    });
    for (const std::size_t c : {std::size_t{0}, std::size_t{1}}) {
      means[c].push_back(mean[c]);
      variances[c].push_back(variance[c]);
    }
  }
  // The relative variance of either colour's cells, as estimated from the other colour.
  std::array<std::vector<double>, 2> relative;
  std::vector<double> sorted;
  for (const std::size_t c : {std::size_t{0}, std::size_t{1}})
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      // Few samples may all have missed the source of a neighbourhood's noise.
      constexpr double of_neighbours = 0.2;
      const double v = std::max(variances[1 - c][b], of_neighbours * around(variances[1 - c], b));
      const double m = means[1 - c][b];
      relative[c].push_back(m > 0 ? v / (m * m) : INFINITY);
      if (m > 0) sorted.push_back(relative[c].back());
    }
  if (sorted.empty()) sorted.push_back(1);
  const auto median = sorted.begin() + static_cast<std::ptrdiff_t>((sorted.size() - 1) / 2);
  std::nth_element(sorted.begin(), median, sorted.end());
  const double least = *median / kMostOfMedian;
  for (const std::size_t c : {std::size_t{0}, std::size_t{1}})
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      const double m = means[1 - c][b];
      weights_[c].push_back(m > 0 ? 1 / (m * std::max(least, relative[c][b])) : 0);
    }
}

/// Mean over 3 x 3 blocks.
double PixelWeights::around(const std::vector<double>& values, std::size_t b) const {
  const int down = static_cast<int>(values.size()) / across_;
  const int bx = static_cast<int>(b) % across_, by = static_cast<int>(b) / across_;
  double sum = 0, count = 0;
  for (int y = std::max(0, by - 1); y <= std::min(down - 1, by + 1); ++y)
    for (int x = std::max(0, bx - 1); x <= std::min(across_ - 1, bx + 1); ++x, count += 1)
      sum += values[static_cast<std::size_t>(y * across_ + x)];
  return sum / count;
}

ChannelMean weighed_mean(const Rendering& rendering, std::size_t channel, const PixelWeights& weight) {
  const Block all{0, 0, rendering.mean.width, rendering.mean.height};
  const auto variance = [&](int x, int y) { return double{rendering.variance->pixel(x, y)[channel]}; };
  ChannelMean mean;
  double weighed_roots = 0;
  for_each_pixel(all, [&](int x, int y) {
    mean.value += weight(x, y) * double{rendering.mean.pixel(x, y)[channel]};
    weighed_roots += weight(x, y) * std::sqrt(variance(x, y));
  });
  mean.known = known_over(all, [&](int x, int y) { return std::pow(weight(x, y), 2) * variance(x, y); });
  const double correlation = correlation_of_pixels(rendering, channel);
  mean.known.variance += correlation * (weighed_roots * weighed_roots - mean.known.variance);
  if (correlation > 0) mean.known.freedom = std::min(mean.known.freedom, stored_mean_error(rendering)->passes - 1);
  return mean;
}

}  // namespace photonproof::inline harness_statistics
