#include "scenes/images/mean_error.h"

#include "scenes/base/text_numbers.h"

namespace photonproof::inline scenes_images {
namespace {

constexpr const char* key = "photonproof:mean_standard_error_and_passes";
constexpr const char* splat_key = "photonproof:pixels_a_splat";
constexpr const char* photons_key = "photonproof:pixels_share_photons";

}  // namespace

void store_mean_error(Rendering& rendering, const MeanError& error) {
  std::string text;
  for (const double value : error.standard_error) text += format_number(value) + " ";
  rendering.metadata[key] = text + format_number(error.passes);
}

std::optional<MeanError> stored_mean_error(const Rendering& rendering) {
  const auto found = rendering.metadata.find(key);
  if (found == rendering.metadata.end()) return std::nullopt;
  std::vector<double> numbers;
  for (const std::string_view part : split_list(found->second)) {
    const Parsed<double> number = parse_number(part);
    if (!number.value || *number.value < 0) return std::nullopt;
    numbers.push_back(*number.value);
  }
  if (numbers.size() != 4 || numbers[3] < 2) return std::nullopt;
  return MeanError{{numbers[0], numbers[1], numbers[2]}, numbers[3]};
}

void store_shared_photons(Rendering& rendering) { rendering.metadata[photons_key] = "yes"; }

bool shares_photons(const Rendering& rendering) { return rendering.metadata.contains(photons_key); }

void scale_values(Rendering& rendering, double factor) {
  const auto scale = [](Image& image, double by) {
    for (float& value : image.rgb) value = static_cast<float>(double{value} * by);
  };
  scale(rendering.mean, factor);
  if (rendering.variance) scale(*rendering.variance, factor * factor);
  std::optional<MeanError> error = stored_mean_error(rendering);
  if (!error) return;
  for (double& e : error->standard_error) e *= factor;
  store_mean_error(rendering, *error);
}

void store_pixels_a_splat(Rendering& rendering, double pixels) {
  rendering.metadata[splat_key] = format_number(pixels);
}

double pixels_a_splat(const Rendering& rendering) {
  const auto found = rendering.metadata.find(splat_key);
  if (found == rendering.metadata.end()) return 1;
  const Parsed<double> pixels = parse_number(found->second);
  constexpr double most = 1e4;  // a filter of a hundred pixels; also the limit for other programs' files
  return pixels.value && *pixels.value >= 1 && *pixels.value <= most ? *pixels.value : 1;
}

}  // namespace photonproof::inline scenes_images
