// False-colour pictures of where two images differ. Scales are fixed, never fitted to the data, so that two heat maps
// can be compared: magma from dark (small) to bright (large).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/metrics.h"

namespace photonproof {

/// FLIP: linear, 0 darkest to 1 brightest.
inline constexpr const char* flip_scale_caption = "FLIP, linear from 0 (dark) to 1 (bright)";

/// Relative squared error of a pixel: logarithmic, 1e-4 (1 % off) or less darkest to 1e2 (ten times off) or more
/// brightest; each decade takes a sixth of the map.
inline constexpr double error_scale_least = 1e-4;
inline constexpr double error_scale_greatest = 1e2;
inline constexpr const char* error_scale_caption =
    "relative squared error of a pixel, logarithmic from 1e-4 (dark) to 1e2 (bright)";

/// One value a pixel, row-major, as colours: linear RGB that write_png turns into exactly the map's bytes.
Image flip_heatmap(int width, int height, const std::vector<float>& flip);
Image error_heatmap(int width, int height, const std::vector<float>& relative_squared_error);

struct HeatmapFiles {
  std::filesystem::path flip, error;
};

/// Writes <folder>/<stem>-flip.png and <folder>/<stem>-error.png, making the folder when it is missing. Throws
/// InputError when they cannot be written. The context (metric_context.h) may be the one the metrics were computed on.
/// Precondition: find_defects is empty.
HeatmapFiles write_heatmaps(const MetricContext& context, const std::filesystem::path& folder, const std::string& stem);
HeatmapFiles write_heatmaps(const Image& reference, const Image& test, const MetricOptions& options,
                            const std::filesystem::path& folder, const std::string& stem);

}  // namespace photonproof
