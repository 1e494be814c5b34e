#include "harness/statistics/pooled_pictures.h"

#include <algorithm>
#include <cmath>

#include "harness/pixels/image_blocks.h"
#include "scenes/images/mean_error.h"

namespace photonproof::inline harness_statistics {
namespace {

/// An engine's own variance may be from few batches.
bool is_of_few_batches(const PictureOfSamples& part) { return part.rendering.metadata.contains("photonproof:batches"); }

/// Raises pixels' variances from few pictures to at least their block's mean.
void steady_by_blocks(Image& variance) {
  const Image raw = variance;
  for (const Block& block : blocks_of(raw.width, raw.height))
    for (std::size_t c = 0; c < 3; ++c) {
      double mean = 0;
      for_each_pixel(block, [&](int x, int y) { mean += double{raw.pixel(x, y)[c]} / block.pixels(); });
      for_each_pixel(block, [&](int x, int y) {
        variance.pixel(x, y)[c] = std::max(raw.pixel(x, y)[c], static_cast<float>(mean));
      });
    }
}

double samples_of_all(const std::vector<PictureOfSamples>& parts) {
  double total = 0;
  for (const PictureOfSamples& part : parts) total += part.samples;
  return total;
}

Rendering weighed_mean(const std::vector<PictureOfSamples>& parts, bool layers) {
  const Image& first = parts.front().rendering.mean;
  Rendering out;
  out.mean = Image(first.width, first.height);
  out.variance = Image(first.width, first.height);
  const double total = samples_of_all(parts);
  for (std::size_t i = 0; i < out.mean.rgb.size(); ++i) {
    double mean = 0, variance = 0;
    for (const auto& [part, samples] : parts) {
      const double weight = samples / total;
      mean += weight * double{part.mean.rgb[i]};
      if (layers) variance += weight * weight * double{part.variance->rgb[i]};
    }
    if (!layers && parts.size() > 1)
      for (const auto& [part, samples] : parts)
        variance += std::pow(double{part.mean.rgb[i]} - mean, 2) / double(parts.size() * (parts.size() - 1));
    out.mean.rgb[i] = static_cast<float>(mean);
    out.variance->rgb[i] = static_cast<float>(variance);
  }
  return out;
}

void pool_mean_error(const std::vector<PictureOfSamples>& parts, Rendering& out) {
  const double total = samples_of_all(parts);
  MeanError error;
  error.passes = 0;
  for (const auto& [part, samples] : parts) {
    const auto stored = stored_mean_error(part);
    if (!stored) return;
    for (std::size_t c = 0; c < 3; ++c)
      error.standard_error[c] += std::pow(samples / total * stored->standard_error[c], 2);
    error.passes += stored->passes;
  }
  for (double& e : error.standard_error) e = std::sqrt(e);
  store_mean_error(out, error);
}

}  // namespace

PooledPicture pool_pictures(const std::vector<PictureOfSamples>& parts) {
  const bool layers = std::ranges::all_of(parts, [](const auto& part) { return part.rendering.variance.has_value(); });
  PooledPicture pooled{weighed_mean(parts, layers)};
  if (!layers || std::ranges::any_of(parts, is_of_few_batches)) steady_by_blocks(*pooled.rendering.variance);
  store_pixels_a_splat(pooled.rendering, pixels_a_splat(parts.front().rendering));
  if (shares_photons(parts.front().rendering)) store_shared_photons(pooled.rendering);
  pool_mean_error(parts, pooled.rendering);
  if (!layers)
    for (const PictureOfSamples& part : parts) pooled.images.push_back(part.rendering.mean);
  return pooled;
}

}  // namespace photonproof::inline harness_statistics
