// Times every metric family by itself, and all of them, on a pair of 512 x 512 images, on one thread.

#include <benchmark/benchmark.h>

#include "harness/metrics/metric_run.h"
#include "harness/metrics/test_images.h"

namespace photonproof::inline harness_metrics {
namespace {

constexpr int side = 512;

struct Pair {
  Image reference = busy_image(side, side, 1);
  Image test = busy_image(side, side, 1, 2);
};
const Pair& images() {
  static const Pair pair;
  return pair;
}

void every_metric(benchmark::State& state) {
  for (auto _ : state) {
    MetricOptions options;
    options.threads = 1;
    benchmark::DoNotOptimize(compute_metrics(images().reference, images().test, options));
  }
  state.SetItemsProcessed(state.iterations() * side * side);
}
BENCHMARK(every_metric)->Unit(benchmark::kMillisecond);

/// ssim on all cores for a 3840 x 2160 pair in memory; oracles/throughput.sh compares it with scikit-image.
void ssim_4k(benchmark::State& state) {
  const Image reference = busy_image(3840, 2160, 1), test = busy_image(3840, 2160, 1, 2);
  MetricOptions options;
  options.only = {"ssim"};
  for (auto _ : state) benchmark::DoNotOptimize(compute_metrics(reference, test, options));
}
BENCHMARK(ssim_4k)->Unit(benchmark::kSecond)->UseRealTime();

/// The time of the row's pass for one run, including the planes that it shares with others.
void one_metric(benchmark::State& state, const MetricRow& row) {
  const TileGrid grid{side, side};
  PairFacts pair{side, side, std::uint64_t{side} * side, false, {}};
  pair.options.parameters.hdr_exposures = ExposureRange{-2, 2, 4};
  TileMemory memory;
  for (auto _ : state) {
    const auto pass = row.pass(pair);
    pass->rows_begin(0, side);
    for (int y = 0; y < side; y += TileGrid::tile_height)
      for (int x = 0; x < side; x += TileGrid::tile_width) {
        const PairTile tile(grid, x, y, {images().reference.rgb.data(), 0}, {images().test.rgb.data(), 0}, nullptr, 0,
                            memory);
        MetricPass::Part part;
        pass->measure(tile, {}, part);
        pass->add(part);
      }
    pass->rows_done(side, [&](std::size_t n, const TileBody& body) {
      for (std::size_t i = 0; i < n; ++i) body(i, memory);
    });
    benchmark::DoNotOptimize(pass->value(row.which));
  }
  state.SetItemsProcessed(state.iterations() * side * side);
}

[[maybe_unused]] const bool registered = [] {
  for (const MetricRow& row : metric_rows())
    if (row.which == 0)
      benchmark::RegisterBenchmark((std::string("metric/") + row.name).c_str(), [&row](benchmark::State& state) {
        one_metric(state, row);
      })->Unit(benchmark::kMillisecond);
  return true;
}();

}  // namespace
}  // namespace photonproof::inline harness_metrics
