// How certain an image's mean is, where that does not follow from its pixels' variances: pixels that light paths or
// photons share vary together. Kept among the image's metadata.
#pragma once

#include <array>
#include <optional>

#include "scenes/images/image.h"

namespace photonproof::inline scenes_images {

struct MeanError {
  std::array<double, 3> standard_error{};  ///< of the mean over all pixels, by channel
  double passes = 0;                       ///< independent estimates of the whole image that showed it; two or more
};

void store_mean_error(Rendering& rendering, const MeanError& error);
/// Empty where the image says nothing of it, or nothing that can be read.
std::optional<MeanError> stored_mean_error(const Rendering& rendering);

/// Of an image to which light paths were added by a reconstruction filter w that is wider than a pixel, so that
/// neighbours vary together: 1 / (integral of w^2)^2 pixels. A sum over many pixels varies so much more than the sum of
/// their variances says; 1 where the image says nothing of it.
void store_pixels_a_splat(Rendering& rendering, double pixels);
double pixels_a_splat(const Rendering& rendering);

/// Of an image whose pixels look up the same photons, or cache records made of them: neighbours vary together over an
/// unknown part of the image, so that a sum over pixels varies more than their variances say.
void store_shared_photons(Rendering& rendering);
bool shares_photons(const Rendering& rendering);

}  // namespace photonproof::inline scenes_images
