// Metrics that are the mean of an error over all channel values.
#pragma once

#include "harness/metrics/metric_rows.h"
#include "harness/pixels/metric_sum.h"

namespace photonproof::inline harness_metrics {

/// The mean over all channel values of Error{}(x, r), two doubles.
template <class Error>
class MeanErrorPass : public SumPass {
 public:
  explicit MeanErrorPass(const PairFacts& pair) : values_(3 * static_cast<double>(pair.counted)) {}

  void measure(const PairTile& tile, const TileMaps&, Part& part) override {
    part.push_back(0);
    for (std::size_t c = 0; c < 3; ++c) {
      const auto r = tile.reference(c), x = tile.test(c);
      part[0] += lane_sum(r.size(),
                          [&](std::size_t i) { return Error{}(static_cast<double>(x[i]), static_cast<double>(r[i])); });
    }
  }

  /// Infinite where an error's divisor is 0.
  std::optional<double> value(std::size_t) const override { return sum(0) / values_; }

 private:
  double values_;
};

}  // namespace photonproof::inline harness_metrics
