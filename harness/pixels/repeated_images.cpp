#include "harness/pixels/repeated_images.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace photonproof::inline harness_pixels {
namespace {

constexpr int half_bits = 10;  // after the leading one

}  // namespace

std::string_view bytes_of(const Image& image) {
  return {reinterpret_cast<const char*>(image.rgb.data()), image.rgb.size() * sizeof(float)};
}

bool has_noise(const Rendering& reference) {
  for (std::size_t i = 0; i < reference.mean.rgb.size(); ++i)
    if (double{reference.variance->rgb[i]} > std::pow(std::ldexp(double{reference.mean.rgb[i]}, -half_bits - 1), 2))
      return true;
  return false;
}

bool is_copy(const Rendering& reference, const Image& image) {
  constexpr double least_expected_misses = 30;
  double expected_misses = 0;
  for (std::size_t i = 0; i < image.rgb.size(); ++i) {
    const float value = reference.mean.rgb[i];
    if (image.rgb[i] != value) return false;
    const double variance = double{reference.variance->rgb[i]};
    if (variance <= 0) continue;
    const double apart = value == 0 ? 0 : std::ldexp(1.0, std::ilogb(value) - half_bits);
    expected_misses += apart > 0 ? std::min(0.5, variance / (apart * apart)) : 0.5;
  }
  return expected_misses >= least_expected_misses;
}

Repeats count_repeats(std::span<const Image* const> images) {
  std::vector<const Image*> different;
  std::unordered_map<std::string_view, std::size_t> seen;
  for (const Image* image : images)
    if (seen.try_emplace(bytes_of(*image), different.size()).second) different.push_back(image);
  Repeats repeats{images.size(), different.size(), 0};
  for (std::size_t i = 1; i < different.size(); ++i) {
    std::size_t values = 0;
    for (std::size_t v = 0; v < different[i]->rgb.size(); ++v)
      if (different[i]->rgb[v] != different[i - 1]->rgb[v]) ++values;
    if (i == 1 || values < repeats.least_difference) repeats.least_difference = values;
  }
  return repeats;
}

}  // namespace photonproof::inline harness_pixels
