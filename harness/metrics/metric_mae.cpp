// Mean and greatest absolute error on linear values: mae = sum |x-r| / N, N = pixels x 3. (idiff's "Mean error" and
// "Max error" of linear images.)

#include <algorithm>
#include <cmath>

#include "harness/metrics/metric_rows.h"
#include "harness/pixels/metric_sum.h"

namespace photonproof::inline harness_metrics {
namespace {

class MaePass : public MetricPass {
 public:
  explicit MaePass(const PairFacts& pair) : values_(3 * static_cast<double>(pair.counted)) {}

  void measure(const PairTile& tile, const TileMaps&, Part& part) override {
    double sum = 0;
    double greatest[8] = {};
    for (std::size_t c = 0; c < 3; ++c) {
      const auto r = tile.reference(c), x = tile.test(c);
      const auto error = [&](std::size_t i) { return std::abs(static_cast<double>(x[i]) - static_cast<double>(r[i])); };
      sum += lane_sum(r.size(), error);
      std::size_t i = 0;
      for (; i + 8 <= r.size(); i += 8)
        for (std::size_t k = 0; k < 8; ++k) greatest[k] = std::max(greatest[k], error(i + k));
      for (; i < r.size(); ++i) greatest[0] = std::max(greatest[0], error(i));
    }
    part = {sum, *std::max_element(greatest, greatest + 8)};
  }

  void add(const Part& part) override {
    sum_ += part[0];
    greatest_ = std::max(greatest_, part[1]);
  }

  std::optional<double> value(std::size_t which) const override { return which == 0 ? sum_ / values_ : greatest_; }

 private:
  double values_, sum_ = 0, greatest_ = 0;
};

}  // namespace

std::unique_ptr<MetricPass> mae_pass(const PairFacts& pair) { return std::make_unique<MaePass>(pair); }

}  // namespace photonproof::inline harness_metrics
