// One picture of several that an engine drew with different seeds: their mean, weighed by samples, and its noise.
#pragma once

#include <vector>

#include "scenes/images/image.h"

namespace photonproof::inline harness_statistics {

struct PictureOfSamples {
  Rendering rendering;
  double samples = 0;  ///< a pixel
};

struct PooledPicture {
  Rendering rendering;          ///< always with a variance: 0 of one picture that has no variance layer
  std::vector<Image> images{};  ///< the pictures, where any of them has no variance layer
};

/// Variance layers add up where every picture has one; else the pictures' differences are the variance. A pixel's
/// variance of few pictures or batches is no less than its block's mean. Metadata on splats, shared photons and the
/// error of the mean are kept (scenes/images/mean_error.h). Preconditions: at least one picture, equal sizes; equal
/// samples where a variance layer is missing.
PooledPicture pool_pictures(const std::vector<PictureOfSamples>& parts);

}  // namespace photonproof::inline harness_statistics
