// Images and shorthands for the metric tests.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "harness/metrics/metric_run.h"
#include "scenes/base/text_numbers.h"

namespace photonproof::inline harness_metrics {

inline Image constant_image(int width, int height, float r, float g, float b) {
  Image image(width, height);
  for (std::size_t p = 0; p < image.pixels(); ++p) {
    image.rgb[3 * p] = r;
    image.rgb[3 * p + 1] = g;
    image.rgb[3 * p + 2] = b;
  }
  return image;
}

/// Colours from 0 to `greatest` that change irregularly from pixel to pixel, but are the same at every call.
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
  const auto values = compute_metrics(reference, test, {.parameters = {.exposure = exposure}});
  const auto found = std::ranges::find(values, name, &MetricValue::name);
  if (found == values.end()) return std::nullopt;
  return found->value;
}

// Keeps whole maps of the metrics that heat maps show, for images in memory. They are LDR-FLIP in [0,1], and relative
// squared error (x-r)^2/(r^2+0.01) averaged over channels. Row-major, one float a pixel.
class KeptMaps : public MapSink {
 public:
  explicit KeptMaps(int width) : width_(static_cast<std::size_t>(width)) {}
  void add(int rows, const float* flip, const float* error) override {
    const std::size_t count = static_cast<std::size_t>(rows) * width_;
    flip_.insert(flip_.end(), flip, flip + count);
    error_.insert(error_.end(), error, error + count);
  }

  std::vector<float> flip_, error_;

 private:
  std::size_t width_;
};

inline std::vector<float> flip_map(const Image& reference, const Image& test, const MetricOptions& options) {
  KeptMaps maps(reference.width);
  measure(reference, test, options, &maps);
  return std::move(maps.flip_);
}

inline std::vector<float> relmse_map(const Image& reference, const Image& test) {
  KeptMaps maps(reference.width);
  measure(reference, test, {}, &maps);
  return std::move(maps.error_);
}

/// The numbers of the parameter's example, which is TOML.
inline std::vector<double> example_of(const MetricParameter& parameter) {
  std::string text = parameter.example;
  std::erase_if(text, [](char c) { return c == '[' || c == ']'; });
  std::vector<double> numbers;
  for (const std::string_view number : split_list(text)) numbers.push_back(parse_number(number).value.value());
  return numbers;
}

}  // namespace photonproof::inline harness_metrics
