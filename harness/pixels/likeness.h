// Images that are too much alike. Two independent renders of a scene differ by the noise of both; one that has the
// noise of another image is a copy of it, or made with the same random numbers.
#pragma once

#include "scenes/images/image.h"

namespace photonproof::inline harness_pixels {

/// Whether the image has the noise of `other`, whose pixels have this variance: their mean squared difference is under
/// a quarter of it, where that variance is more than what rounding to `step` (0: none) does. An independent image,
/// however free of noise, is at its full variance away. Precondition: equal sizes.
bool has_noise_of(const Image& image, const Image& other, const Image& variance, double step);

}  // namespace photonproof::inline harness_pixels
