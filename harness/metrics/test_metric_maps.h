// Whole maps of the metrics that heat maps show, of images in memory: LDR-FLIP in [0,1], and relative squared error
// (x-r)^2/(r^2+0.01) averaged over channels. Row-major, one float a pixel.
#pragma once

#include <utility>
#include <vector>

#include "harness/metrics/metric_run.h"

namespace photonproof {

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

}  // namespace photonproof
