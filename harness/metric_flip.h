// The error map of LDR-FLIP; metric_flip.cpp pools it.
#pragma once

#include <vector>

namespace photonproof {

/// Viewing distance of NVIDIA's tool: 0.7 m from a screen 0.7 m and 3840 pixels wide, 3840 pi / 180 pixels a degree.
inline constexpr double flip_pixels_per_degree = 67.02064327658225;

/// FLIP of each pixel, in [0,1]. `reference` and `test` are interleaved linear RGB in [0,1], 3 * width * height values.
std::vector<float> flip_errors(int width, int height, const std::vector<double>& reference,
                               const std::vector<double>& test);

}  // namespace photonproof
