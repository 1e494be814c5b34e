// The mean of an image in which certain places count more than noisy ones, so that a common error shows best.
#pragma once

#include <array>
#include <vector>

#include "harness/pixels/image_blocks.h"
#include "harness/statistics/deviation.h"
#include "scenes/images/image.h"

namespace photonproof::inline harness_statistics {

/// Weights of the pixels of one channel in its mean over the image, for values r of variance v.
/// * A common factor shows best where values are weighed by r/v. A light's edge, which a few samples decide, then does
///   not drown the rest.
/// * A place's share of the mean is r^2/v; a light without noise would have all of it. So each share is at most four
///   times the median one. With a limit of once the median, keyhole would take 1.7 times the samples for the same
///   power, pool 2.2 times. Where v is proportional to r, r/v is the plain mean, in which bright places count more than
///   dark ones.
/// * The variance v is an estimate, and samples that are high by chance look uncertain. Their own variances would give
///   them too little weight. So the pixels of either colour of a checkerboard take their weights from the other colour,
///   whose noise is independent.
class PixelWeights {
 public:
  /// Precondition: both have a variance.
  PixelWeights(const Rendering& reference, const Rendering& test, std::size_t channel);

  double operator()(int x, int y) const {
    return weights_[colour(x, y)][static_cast<std::size_t>(y / block_side * across_ + x / block_side)];
  }
  /// The larger weight of a pixel in this block of blocks_of.
  double largest_in(std::size_t block) const { return std::max(weights_[0][block], weights_[1][block]); }

 private:
  static std::size_t colour(int x, int y) { return static_cast<std::size_t>((x + y) & 1); }
  double around(const std::vector<double>& values, std::size_t block) const;

  int width_, across_;
  std::array<std::vector<double>, 2> weights_;
};

/// A channel's weighed sum over an image, or its plain mean.
struct ChannelMean {
  double value = 0;
  KnownVariance known;
};

/// Where pixels share light paths, the weighed sum's variance has w^2 v in place of v.
ChannelMean weighed_mean(const Rendering& rendering, std::size_t channel, const PixelWeights& weight);

}  // namespace photonproof::inline harness_statistics
