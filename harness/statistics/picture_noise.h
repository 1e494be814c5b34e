// Two pictures that both have noise: how far the second is from the first in every pixel, block and overall, and how
// far chance could have put it. Verify judges by this what engines draw, as gates judge by deviations.h.
//
// - A picture without a variance layer is a mean of images: its noise is measured as a gate measures it.
// - A variance layer says how certain each pixel is. A pixel counts as no more certain than its block's mean. How
//   variances spread over a block says how skewed samples are, and how well its variance is known (agreement.h).
// - A pixel is taken for a Poisson number of samples of f each. One of the brightest adds f = variance / value. Either
//   picture may miss the brightest sample that any of its blocks met (deviation.h).
// - An image may say that neighbours share splats, or how certain its mean is. Then any two pixels have
//   one correlation, which widens blocks and lowers the number of independent ones (scenes/images/mean_error.h).
// - Of two variance layers, means are also weighed: in many an image a few pixels at a light's edge have nearly all of
//   the noise (weighed_mean.h).
// - Where pixels gather the same photons, nobody knows their correlation. A sum over pixels then counts as fully
//   correlated, which no correlation exceeds; only an error of the mean that the image states is smaller.
#pragma once

#include <span>

#include "harness/statistics/deviations.h"
#include "scenes/images/image.h"

namespace photonproof::inline harness_statistics {

struct NoisyPicture {
  const Rendering& rendering;       ///< with a variance
  std::span<const Image> images{};  ///< whose mean it is, where no variance layer says how certain; else empty
};

/// The picture's own noise: values are in `expected`, differences are 0.
Deviations noise_of(const NoisyPicture& picture);

/// Deviations of the second from the first. Preconditions: equal sizes, finite values; no images or at least two of a
/// picture.
Deviations deviations_between(const NoisyPicture& first, const NoisyPicture& second);

/// The one correlation c of any two pixels that explains an image's MeanError, where pixels share light paths:
/// (error of the sum)^2 = (1 - c) sum v + c (sum sqrt v)^2. 0 where the image says nothing.
double correlation_of_pixels(const Rendering& rendering, std::size_t channel);

}  // namespace photonproof::inline harness_statistics
