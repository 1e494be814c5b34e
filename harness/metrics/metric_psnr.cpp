// Peak signal-to-noise ratio in decibels: 10 log10(1/mse) on display-encoded values, whose peak is 1.

#include <cmath>

#include "harness/metrics/metric_rows.h"
#include "harness/pixels/metric_sum.h"

namespace photonproof::inline harness_metrics {
namespace {

class PsnrPass : public SumPass {
 public:
  explicit PsnrPass(const PairFacts& pair) : values_(3 * static_cast<double>(pair.counted)) {}

  void measure(const PairTile& tile, const TileMaps&, Part& part) override {
    const TileColour r = tile.encoded(0), x = tile.encoded(1);
    const auto width = static_cast<std::size_t>(tile.width());
    part.push_back(0);
    for (std::size_t c = 0; c < 3; ++c)
      for (int y = 0; y < tile.height(); ++y) {
        const double* row_r = r[c].core + static_cast<std::size_t>(y) * r[c].stride;
        const double* row_x = x[c].core + static_cast<std::size_t>(y) * x[c].stride;
        const auto error = [&](std::size_t i) { return (row_x[i] - row_r[i]) * (row_x[i] - row_r[i]); };
        if (tile.all_count())
          part[0] += lane_sum(width, error);
        else
          part[0] +=
              lane_sum(width, [&](std::size_t i) { return tile.counts(static_cast<int>(i), y) ? error(i) : 0.0; });
      }
  }

  std::optional<double> value(std::size_t) const override { return 10 * std::log10(1 / (sum(0) / values_)); }

 private:
  double values_;
};

}  // namespace

std::unique_ptr<MetricPass> psnr_pass(const PairFacts& pair) { return std::make_unique<PsnrPass>(pair); }

std::string psnr_parameters() { return "exposure, peak=1"; }

}  // namespace photonproof::inline harness_metrics
