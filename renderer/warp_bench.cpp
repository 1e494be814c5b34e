// The maps from the unit square, on 4096 points that stay in the cache: one item is one map.

#include <benchmark/benchmark.h>

#include <vector>

#include "renderer/sampler.h"
#include "renderer/warp.h"

namespace photonproof {
namespace {

const std::vector<Vec2<float>>& points() {
  static const std::vector<Vec2<float>> made = [] {
    std::vector<Vec2<float>> u;
    Sampler s(1, Stream::camera, 0, 0);
    for (int i = 0; i < 4096; ++i) u.push_back(s.next2());
    return u;
  }();
  return made;
}

template <class Warp>
void warp(benchmark::State& state, const Warp& map) {
  for (auto _ : state)
    for (const Vec2<float>& u : points()) {
      auto mapped = map(u);
      benchmark::DoNotOptimize(mapped);
    }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(points().size()));
}

BENCHMARK_CAPTURE(warp, disc, [](const Vec2<float>& u) { return square_to_disc(u); });
BENCHMARK_CAPTURE(warp, cosine_hemisphere, [](const Vec2<float>& u) { return square_to_cosine_hemisphere(u); });
BENCHMARK_CAPTURE(warp, sphere, [](const Vec2<float>& u) { return square_to_sphere(u); });
BENCHMARK_CAPTURE(warp, cone, [](const Vec2<float>& u) { return square_to_cone(u, 0.01f); });
BENCHMARK_CAPTURE(warp, frame_to_world, [](const Vec2<float>& u) {
  return Frame(Vec3f{0.6f, 0, u.x < 0.5f ? 0.8f : -0.8f}).to_world({u.x, u.y, 1});
});

}  // namespace
}  // namespace photonproof
