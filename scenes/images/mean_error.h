// Standard error of an image's mean where it does not follow from its pixels' variances: pixels that share light paths
// or photons are correlated. Stored in the image's metadata.
#pragma once

#include <array>
#include <optional>

#include "scenes/images/image.h"

namespace photonproof::inline scenes_images {

struct MeanError {
  std::array<double, 3> standard_error{};  ///< of the mean over all pixels, by channel
  double passes = 0;                       ///< independent estimates of the whole image behind it; two or more
};

void store_mean_error(Rendering& rendering, const MeanError& error);
/// Empty where the image has no such metadata, or none that can be read.
std::optional<MeanError> stored_mean_error(const Rendering& rendering);

/// Multiplies every pixel, with the errors of the pixels and of their mean.
void scale_values(Rendering& rendering, double factor);

/// Pixels per splat, 1 / (integral of w^2)^2, where a reconstruction filter w wider than a pixel added light paths to
/// the image. Neighbours are then correlated, and a sum over many pixels varies this much more than the sum of their
/// variances. It is 1 where the image does not state it.
void store_pixels_a_splat(Rendering& rendering, double pixels);
double pixels_a_splat(const Rendering& rendering);

/// Marks an image whose pixels gather the same photons, or cache records made of them. Neighbours are correlated over
/// an unknown part of the image, so a sum over pixels varies more than the sum of their variances.
void store_shared_photons(Rendering& rendering);
bool shares_photons(const Rendering& rendering);

}  // namespace photonproof::inline scenes_images
