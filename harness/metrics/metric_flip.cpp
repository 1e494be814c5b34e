// Pools the FLIP map into the numbers NVIDIA's tool prints: mean, weighted median and quartiles, maximum. (Andersson,
// Nilsson, Akenine-Möller: "Visualizing and communicating errors in rendered images", Ray Tracing Gems II, 2021)

#include "harness/metrics/metric_flip.h"

#include "harness/metrics/metric_rows.h"

namespace photonproof::inline harness_metrics {
namespace {

class FlipPass : public MetricPass {
 public:
  explicit FlipPass(std::uint64_t pixels) : pool_(pixels) {}

  void measure(const PairTile& tile, const TileMaps& maps, Part&) override {
    const TileColour reference = tile.exposed(0), test = tile.exposed(1);
    const TileMemory::Frame frame(tile.memory());
    auto* steps = tile.memory().take<std::uint32_t>(tile.pixels());
    flip_errors(reference, test, static_cast<std::size_t>(tile.width()), static_cast<std::size_t>(tile.height()),
                tile.memory(), steps);
    pool_.add(tile, steps);
    if (!maps.flip) return;
    for (std::size_t i = 0; i < tile.pixels(); ++i)
      maps.flip[i] = static_cast<float>(steps[i]) / static_cast<float>(flip_steps);
  }

  void add(const Part&) override {}

  std::optional<double> value(std::size_t which) const override {
    if (which == 0) return pool_.mean();
    if (which == 4) return pool_.greatest();
    return pool_.weighted_percentile(0.25 * static_cast<double>(which));
  }

 private:
  FlipPool pool_;
};

}  // namespace

std::unique_ptr<MetricPass> flip_pass(const PairFacts& facts) { return std::make_unique<FlipPass>(facts.counted); }

std::string flip_parameters() { return "exposure, pixels_per_degree=67.0206"; }

}  // namespace photonproof::inline harness_metrics
