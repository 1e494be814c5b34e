// Relative squared error of each pixel: behind relmse, relmse_trimmed and the error heat map.
#pragma once

#include <vector>

#include "scenes/image.h"

namespace photonproof {

/// Mean over a pixel's channels of (x-r)^2/(r^2+0.01), one value a pixel.
std::vector<double> relative_squared_errors(const Image& reference, const Image& test);

}  // namespace photonproof
