#include "reports/page/pixel_data.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "reports/page/reduced_image.h"
#include "reports/view/deflated.h"
#include "reports/view/flip_values.h"
#include "reports/view/results_file.h"
#include "reports/view/text.h"
#include "scenes/base/input_error.h"

namespace photonproof::reports::inline reports_page {
namespace {

constexpr int steps_an_octave = 256;
constexpr int code_of_one = 20 * steps_an_octave + 1;  // 2^-20 has code 1
constexpr int largest_code = code_of_one + 28 * steps_an_octave;
constexpr std::int16_t code_of_infinity = 32766, code_of_nan = 32767;
constexpr int largest_side = 4096;

/// Maps small differences of either sign to small numbers.
std::uint16_t folded(std::uint16_t difference) {
  const auto value = static_cast<std::int16_t>(difference);
  return static_cast<std::uint16_t>(value < 0 ? -2 * value - 1 : 2 * value);
}

LoadedImage load(const std::filesystem::path& folder, const PixelSource& source, double exposure) {
  const ResultsFile exact = results_file(folder, source.image), picture = results_file(folder, source.picture);
  const bool from_picture = !exact.problem.empty();
  const ResultsFile& file = from_picture ? picture : exact;
  if (!file.problem.empty()) return {{}, {}, false, source.image.empty() ? picture.problem : exact.problem};
  try {
    Image image = read_rendering(file.path.string(), "", ImageWindow::stored).mean;
    if (image.width > largest_side || image.height > largest_side) return {{}, {}, false, "it is too large to show"};
    if (from_picture) {
      const auto scale = static_cast<float>(std::exp2(-exposure));
      for (float& value : image.rgb) value *= scale;
    }
    std::optional<Image> flip = flip_values(folder, source.flip);
    if (flip && (flip->width != image.width || flip->height != image.height)) flip.reset();
    return {std::move(image), std::move(flip), from_picture, {}};
  } catch (const InputError&) {
    return {{}, {}, false, (from_picture ? source.picture : source.image) + " cannot be read"};
  }
}

}  // namespace

std::int16_t pixel_code(float value) {
  if (std::isnan(value)) return code_of_nan;
  if (std::isinf(value)) return value > 0 ? code_of_infinity : static_cast<std::int16_t>(-code_of_infinity);
  if (value == 0) return 0;
  const double code = std::round(steps_an_octave * std::log2(std::abs(static_cast<double>(value)))) + code_of_one;
  if (code < 1) return 0;
  const int clamped = static_cast<int>(std::min<double>(code, largest_code));
  return static_cast<std::int16_t>(value < 0 ? -clamped : clamped);
}

std::string packed_pixels(const Image& image) {
  const std::size_t pixels = image.pixels();
  std::string planes(6 * pixels, '\0');
  std::uint16_t left[3] = {0, 0, 0};
  for (std::size_t i = 0; i < pixels; ++i) {
    std::uint16_t code[3];
    for (std::size_t c = 0; c < 3; ++c) code[c] = static_cast<std::uint16_t>(pixel_code(image.rgb[3 * i + c]));
    const std::uint16_t values[3] = {code[1], static_cast<std::uint16_t>(code[0] - code[1]),
                                     static_cast<std::uint16_t>(code[2] - code[1])};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint16_t stored = folded(static_cast<std::uint16_t>(values[k] - left[k]));
      planes[2 * k * pixels + i] = static_cast<char>(stored & 0xFF);
      planes[(2 * k + 1) * pixels + i] = static_cast<char>(stored >> 8);
      left[k] = values[k];
    }
  }
  return deflated(planes);
}

PixelDataSet pixel_data(const std::filesystem::path& folder, const std::vector<PixelSource>& sources, double exposure,
                        std::size_t allowance) {
  std::vector<LoadedImage> loaded;
  loaded.reserve(sources.size());
  for (const PixelSource& source : sources) loaded.push_back(load(folder, source, exposure));
  return pixel_data(loaded, allowance);
}

PixelDataSet pixel_data(const std::vector<LoadedImage>& images, std::size_t allowance) {
  int longest = 1;
  for (const LoadedImage& each : images)
    if (each.image) longest = std::max({longest, each.image->width, each.image->height});
  for (int factor = 1;;) {
    PixelDataSet set;
    set.reduced_by = factor;
    std::size_t bytes = 0;
    for (const LoadedImage& each : images) {
      PixelData& pixels = set.images.emplace_back();
      pixels.problem = each.problem;
      if (!each.image) continue;
      pixels.width = each.image->width;
      pixels.height = each.image->height;
      pixels.from_picture = each.from_picture;
      const auto reduced = [&](const Image& image) { return factor == 1 ? image : reduced_image(image, factor); };
      pixels.base64 = base64(packed_pixels(reduced(*each.image)));
      if (each.flip) pixels.flip_base64 = base64(packed_flip(reduced(*each.flip)));
      bytes += pixels.base64.size() + pixels.flip_base64.size();
    }
    if (bytes <= allowance || factor >= longest) return set;
    // Averages of k x k pixels have less noise, but take more than half of bytes/k², so smaller factors are not tried.
    const double excess = static_cast<double>(bytes) / static_cast<double>(allowance);
    factor = factor == 1 ? std::max(2, static_cast<int>(std::sqrt(excess / 2))) : factor + 1;
  }
}

}  // namespace photonproof::reports::inline reports_page
