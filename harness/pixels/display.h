// Converts linear radiance to display values for psnr, ssim and flip. The caller fixes the exposure; an automatic one
// would make two scores incomparable.
#pragma once

#include <vector>

#include "scenes/base/srgb.h"
#include "scenes/images/image.h"

namespace photonproof::inline harness_pixels {

/// min(1, max(0, 2^exposure * v)) of every value: still linear, interleaved RGB as in Image. Precondition: 2^exposure
/// and the image are finite.
std::vector<double> expose(const Image& image, double exposure);

using scenes_base::encode_srgb;
/// The same of every value.
std::vector<double> encode_srgb(const std::vector<double>& linear);

}  // namespace photonproof::inline harness_pixels
