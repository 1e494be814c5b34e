#include "reports/view/flip_values.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "reports/record/heatmap_magma.h"
#include "reports/view/deflated.h"
#include "reports/view/results_file.h"
#include "scenes/base/input_error.h"

namespace photonproof::reports::inline reports_view {
namespace {

std::unordered_map<std::uint32_t, float> values_of_colours() {
  std::unordered_map<std::uint32_t, float> values;
  for (std::size_t i = 0; i < magma_colours.size(); ++i)
    values.emplace(magma_colours[i], static_cast<float>(i) / static_cast<float>(magma_colours.size() - 1));
  return values;
}

}  // namespace

std::optional<Image> flip_values(const std::filesystem::path& folder, const std::string& relative) {
  static const std::unordered_map<std::uint32_t, float> values = values_of_colours();
  const ResultsFile file = results_file(folder, relative);
  if (!file.problem.empty()) return std::nullopt;
  try {
    Image image = read_texture_image(file.path.string(), true);
    for (std::size_t i = 0; i < image.rgb.size(); i += 3) {
      std::uint32_t colour = 0;
      for (std::size_t c = i; c < i + 3; ++c)
        colour = colour << 8 | static_cast<std::uint32_t>(255 * image.rgb[c] + 0.5f);
      const auto found = values.find(colour);
      if (found == values.end()) return std::nullopt;
      std::fill_n(&image.rgb[i], 3, found->second);
    }
    return image;
  } catch (const InputError&) {
    return std::nullopt;
  }
}

std::string packed_flip(const Image& values) {
  std::string bytes(values.pixels(), '\0');
  int left = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const int value = static_cast<int>(std::lround(255 * std::clamp(values.rgb[3 * i], 0.0f, 1.0f)));
    bytes[i] = static_cast<char>((value - left) & 0xFF);
    left = value;
  }
  return deflated(bytes);
}

}  // namespace photonproof::reports::inline reports_view
