// Whether single precision, in which images are kept, holds the variances of one.
#pragma once

#include <string>

#include "scenes/images/image.h"

namespace photonproof::inline harness_statistics {

/// Radiances whose squares are floats, and of the brightest pixel, the least whose square is one still where noise is a
/// ten thousandth of it.
inline constexpr double most_radiance = 1e19, least_radiance = 1e-15;

/// What is wrong with an image whose variance cannot be told, in other words after its name: its brightest pixel is out
/// of that range. Empty where it is in it, and where all pixels are 0.
std::string why_variance_is_lost(const Image& image);

}  // namespace photonproof::inline harness_statistics
