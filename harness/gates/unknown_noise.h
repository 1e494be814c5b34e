// The noise of a reference that states none: one golden image without a variance.
#pragma once

#include <span>

#include "scenes/images/image.h"

namespace photonproof::inline harness_gates {

/// The reference with an estimated variance, the same for all pixels of a block of 8 x 8. It is half the mean square of
/// the differences that neighbours have in reference minus mean, less the noise of the images' mean. Neighbours of an
/// image share little noise and most errors. Fine errors, such as a sharp edge at another place, count as noise.
/// Preconditions: equal sizes, at least one image.
Rendering with_estimated_noise(const Rendering& reference, std::span<const Image* const> images);

}  // namespace photonproof::inline harness_gates
