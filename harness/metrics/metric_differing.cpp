// Pixels off by more than a bound: the share of them, and their number. Values are compared as psnr does, displayed:
// scaled by 2^exposure, clamped to [0,1], sRGB-encoded. A pixel's difference is that of its worst channel. A step of 8
// bits is 1/255 = 0.00392.

#include <cmath>

#include "harness/metrics/metric_rows.h"
#include "harness/pixels/metric_sum.h"

namespace photonproof::inline harness_metrics {
namespace {

constexpr double rounding = 1e-6;  // of displayed values that are decoded, kept as floats and encoded again

class DifferingPass : public SumPass {
 public:
  explicit DifferingPass(const PairFacts& pair)
      : pixels_(static_cast<double>(pair.counted)), most_(pair.options.parameters.more_than + rounding) {}

  void measure(const PairTile& tile, const TileMaps&, Part& part) override {
    const TileColour r = tile.encoded(0), x = tile.encoded(1);
    double off = 0;
    for (int y = 0; y < tile.height(); ++y)
      for (int column = 0; column < tile.width(); ++column) {
        if (!tile.counts(column, y)) continue;
        bool is_near = true;
        for (std::size_t c = 0; c < 3; ++c) {
          const double* row_r = r[c].core + static_cast<std::size_t>(y) * r[c].stride;
          const double* row_x = x[c].core + static_cast<std::size_t>(y) * x[c].stride;
          is_near = is_near && std::abs(row_x[column] - row_r[column]) <= most_;  // false for NaN
        }
        if (!is_near) ++off;
      }
    part.push_back(off);
  }

  std::optional<double> value(std::size_t which) const override { return which == 0 ? sum(0) / pixels_ : sum(0); }

 private:
  double pixels_, most_;
};

}  // namespace

std::unique_ptr<MetricPass> differing_pass(const PairFacts& pair) { return std::make_unique<DifferingPass>(pair); }

std::string differing_parameters() { return "exposure, more_than"; }

}  // namespace photonproof::inline harness_metrics
