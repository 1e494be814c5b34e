// Two pictures that both have noise: the deviation of the second from the first in every pixel, block and overall, and
// the part that chance explains. `verify` judges engines' pictures by this, as gates judge by deviations.h.
//
// * A picture without a variance layer is a mean of images: its noise is measured as a gate measures it.
// * A variance layer gives each pixel's variance. A pixel counts as no more certain than its block's mean. The spread
//   of variances over a block gives the samples' skewness and the degrees of freedom of the variance (agreement.h).
// * A pixel is taken for a Poisson number of samples of f each. One of the brightest adds f = variance / value. Either
//   picture may miss the brightest sample that any of its blocks met (deviation.h).
// * An image may state that neighbours share splats, or the error of its mean. Then any two pixels have one
//   correlation, which widens blocks and lowers the number of independent ones (scenes/images/mean_error.h).
// * With two variance layers, means are also weighed: in many images a few pixels at a light's edge have nearly all of
//   the noise (weighed_mean.h).
// * Where pixels gather the same photons, their correlation is unknown. A sum over pixels then counts as fully
//   correlated, which no correlation exceeds. Only a stated error of the mean is smaller.
#pragma once

#include <span>

#include "harness/statistics/deviations.h"
#include "scenes/images/image.h"

namespace photonproof::inline harness_statistics {

struct NoisyPicture {
  const Rendering& rendering;       ///< With a variance.
  std::span<const Image> images{};  ///< The images of this mean, where there is no variance layer; else empty.
};

/// The picture's own noise: values are in `expected`, differences are 0.
Deviations noise_of(const NoisyPicture& picture);

/// Deviations of the second from the first. Preconditions: equal sizes, finite values; no images or at least two of a
/// picture.
Deviations deviations_between(const NoisyPicture& first, const NoisyPicture& second);

/// The one correlation c of any two pixels that explains an image's MeanError, where pixels share light paths. It
/// solves (error of the sum)^2 = (1 - c) sum v + c (sum sqrt v)^2. 0 where the image states no error.
double correlation_of_pixels(const Rendering& rendering, std::size_t channel);

}  // namespace photonproof::inline harness_statistics
