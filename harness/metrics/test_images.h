// Images and shorthands the metric tests share.
#pragma once

#include <algorithm>
#include <optional>
#include <string>

#include "harness/metrics/metrics.h"

namespace photonproof {

inline Image constant_image(int width, int height, float r, float g, float b) {
  Image image(width, height);
  for (std::size_t p = 0; p < image.pixels(); ++p) {
    image.rgb[3 * p] = r;
    image.rgb[3 * p + 1] = g;
    image.rgb[3 * p + 2] = b;
  }
  return image;
}

/// Colours that change from pixel to pixel, without order but the same at every call, from 0 to `greatest`.
inline Image busy_image(int width, int height, float greatest = 1, unsigned seed = 1) {
  Image image(width, height);
  unsigned state = seed;
  for (float& value : image.rgb) {
    state = state * 1664525u + 1013904223u;  // Numerical Recipes' linear congruential generator
    value = greatest * static_cast<float>(state >> 8) / 16777216.0f;
  }
  return image;
}

/// The metric's value, or nothing when compute_metrics leaves it out.
inline std::optional<double> metric_value(const std::string& name, const Image& reference, const Image& test,
                                          double exposure = 0) {
  const auto values = compute_metrics(reference, test, {exposure});
  const auto found = std::ranges::find(values, name, &MetricValue::name);
  if (found == values.end()) return std::nullopt;
  return found->value;
}

}  // namespace photonproof
