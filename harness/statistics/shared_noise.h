// Noise that pixels of one image share: photons that many pixels gather, splats, one set of lights for an image.
// Statistics that add up pixels or blocks as if independent call such images wrong. K images show it: means over blocks
// of 8 x 8 pixels, or over the image, then vary more between images than independent pixels allow.
//
// * Within blocks: the variance of a block's mean over that of independent pixels, (1/n^2) sum s^2. The ratio is 1 + (n
//   - 1) r where any two of n pixels have the correlation r.
// * Between blocks: B equal variances, of which any two blocks correlate by r_bc, sum up to a chi^2. It spreads as one
//   of B^2 / sum r_bc^2 degrees of freedom does (Satterthwaite 1946), the number of independent blocks. Sample
//   correlations of K images are too large by chance: E[r^2] = r^2 + (1 - r^2) / (K - 1). This excess is subtracted.
#pragma once

#include <cstddef>
#include <span>

#include "scenes/images/image.h"

namespace photonproof::inline harness_statistics {

struct SharedNoise {
  std::size_t images = 0, blocks = 0;  ///< Blocks that have noise.
  double within_blocks = 1;            ///< The ratio above, mean over the blocks; 1 where the images show no noise.
  double independent_blocks = 0;       ///< At least 1, at most `blocks`.
  /// `independent_blocks` less its standard error by chance and few images. `blocks` itself for two images, which show
  /// no correlation.
  double surely_independent() const;
  /// Degrees of freedom of `within_blocks`.
  double freedom() const { return static_cast<double>(images - 1) * independent_blocks; }
  /// Whether independent pixels, or blocks, give such values with probability below `level`.
  bool is_within_blocks(double level = 1e-3) const;
  bool is_between_blocks(double level = 1e-3) const;
};

/// The shared noise of one channel. `variance`: of a pixel of one image, from the images' own variance layers; null:
/// from the differences of the images. Preconditions: at least two images; equal sizes, finite values.
SharedNoise shared_noise(std::span<const Image* const> images, std::size_t channel, const Image* variance = nullptr);

/// The channel that shares most between blocks, else within them.
SharedNoise shared_noise(std::span<const Image* const> images, const Image* variance = nullptr);

}  // namespace photonproof::inline harness_statistics
