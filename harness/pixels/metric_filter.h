// Kernels of the separable filters in pixel_loops.h.
#pragma once

#include "harness/pixels/pixel_loops.h"

namespace photonproof::inline harness_pixels {

/// exp(-x^2 / (2 sigma^2)) at x = -radius ... radius, scaled to sum to 1.
Taps gaussian_taps(double sigma, int radius);

}  // namespace photonproof::inline harness_pixels
