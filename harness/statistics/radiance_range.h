// Whether single precision, the format of images, holds the variances of an image.
#pragma once

#include <string>

#include "scenes/images/image.h"

namespace photonproof::inline harness_statistics {

/// The range of the brightest pixel's radiance. The square of the largest is a float; so is the square of the least
/// times 1e-4, the least relative noise.
inline constexpr double most_radiance = 1e19, least_radiance = 1e-15;

/// The defect of an image whose brightest pixel is out of that range, worded to follow its name. Empty where the pixel
/// is within it, and where all pixels are 0.
std::string why_variance_is_lost(const Image& image);

}  // namespace photonproof::inline harness_statistics
