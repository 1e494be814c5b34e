// Detects images that are too similar. Two independent renders of a scene differ by the noise of both. An image with
// the noise of another is a copy of it, or was made with the same random numbers.
#pragma once

#include "scenes/images/image.h"

namespace photonproof::inline harness_pixels {

/// Whether the image has the noise of `other`, whose pixels have the given variance. It has if their mean squared
/// difference is under a quarter of that variance. False unless the mean variance is 8 times that of rounding to `step`
/// (0: no rounding). An independent image, even one without noise, differs by the full variance. Precondition: equal
/// sizes.
bool has_noise_of(const Image& image, const Image& other, const Image& variance, double step);

}  // namespace photonproof::inline harness_pixels
