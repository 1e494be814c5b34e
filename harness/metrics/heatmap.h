// False-colour pictures of the difference of two images. Scales are fixed, never fitted to the data, so that two heat
// maps can be compared: magma from dark (small) to bright (large).
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "harness/metrics/metric_run.h"

namespace photonproof::inline harness_metrics {

/// FLIP: linear, 0 darkest to 1 brightest.
inline constexpr const char* flip_scale_caption = "FLIP, linear from 0 (dark) to 1 (bright)";

/// Relative squared error of a pixel on a logarithmic scale, a sixth of the map a decade. The darkest entry is 1e-4 (1
/// % off) or less, the brightest 1e2 (ten times off) or more.
inline constexpr double error_scale_least = 1e-4;
inline constexpr double error_scale_greatest = 1e2;
inline constexpr const char* error_scale_caption =
    "relative squared error of a pixel, logarithmic from 1e-4 (dark) to 1e2 (bright)";

/// The colour map's entry for a value on its scale.
std::uint8_t flip_shade(float flip);
std::uint8_t error_shade(float relative_squared_error);

struct HeatmapFiles {
  std::filesystem::path flip, error;
};

/// <folder>/<stem>-flip.png and <folder>/<stem>-error.png
HeatmapFiles heatmap_files(const std::filesystem::path& folder, const std::string& stem);

/// Writes heatmap_files while the metrics run.
class HeatmapWriter : public MapSink {
 public:
  /// Makes the folder when it is missing. Throws InputError when the files cannot be written.
  HeatmapWriter(int width, int height, const std::filesystem::path& folder, const std::string& stem);
  void add(int rows, const float* flip, const float* error) override;
  /// Call it after the last row; without it there are no files.
  HeatmapFiles finish();

 private:
  std::size_t width_;
  HeatmapFiles files_;
  PngRows flip_, error_;
};

}  // namespace photonproof::inline harness_metrics
