// Relative bias, signed: mean(x-r)/mean(r), over all channels or over one: lost or gained energy, independent of noise.

#include "harness/metrics/metric_rows.h"
#include "harness/pixels/metric_sum.h"

namespace photonproof::inline harness_metrics {
namespace {

class BiasPass : public SumPass {
 public:
  void measure(const PairTile& tile, const TileMaps&, Part& part) override {
    for (std::size_t c = 0; c < 3; ++c) {
      const auto r = tile.reference(c), x = tile.test(c);
      part.push_back(lane_sum(r.size(), [&](std::size_t i) { return static_cast<double>(r[i]); }));
      part.push_back(
          lane_sum(r.size(), [&](std::size_t i) { return static_cast<double>(x[i]) - static_cast<double>(r[i]); }));
    }
  }

  std::optional<double> value(std::size_t which) const override {
    const auto over = [&](std::size_t i) {
      return which == 0 ? sum(i) + sum(i + 2) + sum(i + 4) : sum(2 * which - 2 + i);
    };
    const double reference = over(0), difference = over(1);
    if (reference == 0) return std::nullopt;
    return difference / reference;
  }
};

}  // namespace

std::unique_ptr<MetricPass> bias_pass(const PairFacts&) { return std::make_unique<BiasPass>(); }

}  // namespace photonproof::inline harness_metrics
