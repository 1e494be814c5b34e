#include "renderer/photon_mapping/adaptive_sample_map.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

namespace photonproof::inline renderer_photon_mapping {
namespace {

/// Relative standard deviation of one camera sample; 1 where neither passes nor a pilot give it.
float deviation(const AdaptiveSampleMap::Pixel& p) {
  const double mean = p.passes > 0 ? p.sum / p.samples : 0, square = mean * mean + Film::relative_epsilon;
  const double seen = p.passes < 2 ? square : std::max(0.0, (p.squares - p.sum * mean) / (p.passes - 1));
  return static_cast<float>(std::sqrt(std::max(seen, p.pilot_variance) / square));
}

/// Replaces every value by the largest of itself and its two neighbours, for `count` values at `step` from `begin`.
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

void AdaptiveSampleMap::choose() {
  std::vector<float> deviations(pixels_.size());
  std::ranges::transform(pixels_, deviations.begin(), deviation);
  // A neighbour often finds rare light first.
  const auto width = static_cast<std::size_t>(window_.width()), height = static_cast<std::size_t>(window_.height());
  for (std::size_t y = 0; y < height; ++y) spread(deviations, y * width, width, 1);
  for (std::size_t x = 0; x < width; ++x) spread(deviations, x, height, width);
  const double mean =
      std::accumulate(deviations.begin(), deviations.end(), 0.0) / static_cast<double>(deviations.size());
  if (!(mean > 0)) return;
  const auto inverse = static_cast<float>(1 / mean);
  std::ranges::transform(deviations, extra_.begin(), [&](float deviation) {
    // The total is a power of two, so that neighbours often agree and are traced together.
    const auto samples = static_cast<std::uint32_t>(std::clamp(deviation * inverse, 1.0f, float{most + 1}));
    return static_cast<std::uint8_t>(std::bit_floor(samples) - 1);
  });
}

}  // namespace photonproof::inline renderer_photon_mapping
