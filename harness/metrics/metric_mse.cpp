// Mean squared error and its root, on linear values: mse = sum (x-r)^2 / N, N = pixels x 3.

#include <cmath>

#include "harness/metrics/metric_rows.h"
#include "harness/pixels/metric_sum.h"

namespace photonproof::inline harness_metrics {
namespace {

class MsePass : public SumPass {
 public:
  explicit MsePass(const PairFacts& pair) : values_(3 * static_cast<double>(pair.counted)) {}

  void measure(const PairTile& tile, const TileMaps&, Part& part) override {
    part.push_back(0);
    for (std::size_t c = 0; c < 3; ++c) {
      const auto r = tile.reference(c), x = tile.test(c);
      part[0] += lane_sum(r.size(), [&](std::size_t i) {
        const double difference = static_cast<double>(x[i]) - static_cast<double>(r[i]);
        return difference * difference;
      });
    }
  }

  std::optional<double> value(std::size_t which) const override {
    const double mse = sum(0) / values_;
    return which == 0 ? mse : std::sqrt(mse);
  }

 private:
  double values_;
};

}  // namespace

std::unique_ptr<MetricPass> mse_pass(const PairFacts& pair) { return std::make_unique<MsePass>(pair); }

}  // namespace photonproof::inline harness_metrics
