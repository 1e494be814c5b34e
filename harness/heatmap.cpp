#include "harness/heatmap.h"

#include <algorithm>
#include <cmath>
#include <system_error>

#include "harness/display.h"
#include "harness/heatmap_magma.h"
#include "harness/metric_context.h"
#include "scenes/input_error.h"

namespace photonproof {
namespace {

/// Colours the values; `position(value)` is where a value lies on the scale, clamped to [0,1] here.
template <class Position>
Image colour(int width, int height, const std::vector<float>& values, const Position& position) {
  std::array<std::array<float, 3>, 256> linear{};
  for (std::size_t i = 0; i < linear.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      linear[i][c] = static_cast<float>(decode_srgb((magma_colours[i] >> (16 - 8 * c) & 0xff) / 255.0));
  Image image(width, height);
  for (std::size_t p = 0; p < values.size(); ++p) {
    const double at = std::clamp(position(static_cast<double>(values[p])), 0.0, 1.0);
    const auto& rgb = linear[static_cast<std::size_t>(std::lround(255 * at))];
    std::copy(rgb.begin(), rgb.end(), image.rgb.begin() + static_cast<std::ptrdiff_t>(3 * p));
  }
  return image;
}

}  // namespace

Image flip_heatmap(int width, int height, const std::vector<float>& flip) {
  return colour(width, height, flip, [](double value) { return value; });
}

Image error_heatmap(int width, int height, const std::vector<float>& relative_squared_error) {
  return colour(width, height, relative_squared_error, [](double value) {
    // log(0) is -infinity, which the clamp takes to the dark end.
    return std::log(value / error_scale_least) / std::log(error_scale_greatest / error_scale_least);
  });
}

HeatmapFiles write_heatmaps(const MetricContext& context, const std::filesystem::path& folder,
                            const std::string& stem) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw InputError(folder.string(), "folder cannot be made: " + error.message());
  const Image& size = context.reference();
  HeatmapFiles files{folder / (stem + "-flip.png"), folder / (stem + "-error.png")};
  write_png(files.flip.string(), flip_heatmap(size.width, size.height, context.flip_map()));
  write_png(files.error.string(),
            error_heatmap(size.width, size.height, relmse_map(context.reference(), context.test())));
  return files;
}

HeatmapFiles write_heatmaps(const Image& reference, const Image& test, const MetricOptions& options,
                            const std::filesystem::path& folder, const std::string& stem) {
  return write_heatmaps(MetricContext(reference, test, options), folder, stem);
}

}  // namespace photonproof
