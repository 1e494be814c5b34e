// Every metric by itself, and all of them on one shared context, on a pair of 512 x 512 images.

#include <benchmark/benchmark.h>

#include "harness/metric_rows.h"
#include "harness/metric_test_images.h"

namespace photonproof {
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
  for (auto _ : state) benchmark::DoNotOptimize(compute_metrics(images().reference, images().test, {}));
  state.SetItemsProcessed(state.iterations() * side * side);
}
BENCHMARK(every_metric)->Unit(benchmark::kMillisecond);

[[maybe_unused]] const bool registered = [] {
  for (const MetricRow& row : metric_rows()) {
    const auto body = [&row](benchmark::State& state) {
      for (auto _ : state) benchmark::DoNotOptimize(row.value(MetricContext(images().reference, images().test, {})));
      state.SetItemsProcessed(state.iterations() * side * side);
    };
    benchmark::RegisterBenchmark((std::string("metric/") + row.name).c_str(), body)->Unit(benchmark::kMillisecond);
  }
  return true;
}();

}  // namespace
}  // namespace photonproof
