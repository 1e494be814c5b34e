#include "renderer/passes/pixel_effort.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

namespace photonproof {
namespace {

/// Samples for one of other pixels, where a part of the image up to so much is seen by mirrors or through glass.
constexpr float least_by_specular = 4;
constexpr double most_by_specular = 0.2;

/// Relative deviation of one camera sample.
float deviation(const PixelEffort::Pixel& p) {
  if (p.passes < 2) return 0;
  const double mean = p.sum / p.samples;
  const double variance = std::max(0.0, (p.squares - p.sum * mean) / (p.passes - 1));
  return static_cast<float>(std::sqrt(variance / (mean * mean + Film::relative_epsilon)));
}

/// The largest of every value and its two neighbours at `step`, for `count` values from `begin` on.
void spread(std::vector<float>& values, std::size_t begin, std::size_t count, std::size_t step) {
  float before = 0;
  for (std::size_t i = 0; i < count; ++i) {
    float& value = values[begin + i * step];
    const float own = value;
    const float after = i + 1 < count ? values[begin + (i + 1) * step] : 0.0f;
    value = std::max({before, own, after});
    before = own;
  }
}

}  // namespace

void PixelEffort::choose() {
  std::vector<float> deviations(pixels_.size());
  std::ranges::transform(pixels_, deviations.begin(), deviation);
  // What is rare is often met in a neighbour first.
  const auto width = static_cast<std::size_t>(window_.width()), height = static_cast<std::size_t>(window_.height());
  for (std::size_t y = 0; y < height; ++y) spread(deviations, y * width, width, 1);
  for (std::size_t x = 0; x < width; ++x) spread(deviations, x, height, width);
  const double mean =
      std::accumulate(deviations.begin(), deviations.end(), 0.0) / static_cast<double>(deviations.size());
  if (!(mean > 0)) return;
  const auto inverse = static_cast<float>(1 / mean);
  const auto by_specular = std::ranges::count_if(pixels_, [](const Pixel& p) { return p.by_specular > 0; });
  const bool few = static_cast<double>(by_specular) < most_by_specular * static_cast<double>(pixels_.size());
  std::ranges::transform(deviations, pixels_, extra_.begin(), [&](float deviation, const Pixel& p) {
    const float least = few && p.by_specular > 0 ? least_by_specular : 1;
    // In all, a power of two, so that neighbours often agree and are traced together.
    const auto samples = static_cast<std::uint32_t>(std::clamp(deviation * inverse, least, float{most + 1}));
    return static_cast<std::uint8_t>(std::bit_floor(samples) - 1);
  });
}

}  // namespace photonproof
