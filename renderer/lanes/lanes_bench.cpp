// Random numbers and warps per lane, in packs. Shading by material, for paths inside a closed ball of it, where rays
// are almost free. One thread; items are random numbers, warps and bounces.

#define PHOTONPROOF_PACKS
#include <benchmark/benchmark.h>

#include <string>

#include "renderer/integrators/test_scenes.h"
#include "renderer/kernels/isa.h"
#include "renderer/lanes/sampler.h"
#include "renderer/lanes/warp.h"
#include "renderer/planning/test_compiled.h"

namespace photonproof::inline renderer_lanes {
namespace {

using F = stdx::native_simd<float>;
using U = UInt<F>;

void draw(benchmark::State& state, SamplerKind kind) {
  U index = lane_index<F>();
  for (auto _ : state) {
    benchmark::DoNotOptimize(draw2<F>(kind, U(12345u), index, U(3u)));
    index += static_cast<std::uint32_t>(lane_count<F>);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(lane_count<F>));
}
BENCHMARK_CAPTURE(draw, sobol, SamplerKind::sobol)->Name("sampler/sobol");
BENCHMARK_CAPTURE(draw, independent, SamplerKind::independent)->Name("sampler/independent");

template <class Warp>
void warp(benchmark::State& state, Warp&& body) {
  const Vec2<F> u = draw2<F>(SamplerKind::independent, U(1u), lane_index<F>(), U(0u));
  for (auto _ : state) {
    Vec2<F> input = u;
    benchmark::DoNotOptimize(input);
    benchmark::DoNotOptimize(body(input));
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(lane_count<F>));
}
BENCHMARK_CAPTURE(warp, disc, [](const Vec2<F>& u) { return square_to_disc(u); });
BENCHMARK_CAPTURE(warp, cosine_hemisphere, [](const Vec2<F>& u) { return square_to_cosine_hemisphere(u); });
BENCHMARK_CAPTURE(warp, sphere, [](const Vec2<F>& u) { return square_to_sphere(u); });
BENCHMARK_CAPTURE(warp, cone, [](const Vec2<F>& u) { return square_to_cone(u, F(0.01f)); });
BENCHMARK_CAPTURE(warp, frame, [](const Vec2<F>& u) {
  return Frame<F>({u.x, u.y, F(0.5f)}).to_world({u.x, u.y, u.x});
});

void shade(benchmark::State& state, const decltype(BsdfDescription::model)& material) {
  SceneDescription description;
  test::add_shape(description, SphereDescription{}, {}, test::add_bsdf(description, material)).flip_normals = true;
  test::set_camera(description, {}, 90, 16);
  const Scene scene = test::compiled(description, 16, 16);
  const std::string best;
  const Kernels& kernels = kernels_for(best);
  std::vector<std::uint32_t> scratch(kernels.path.scratch);
  std::vector<float> radiance(3 * 16 * 16 * 16);
  std::uint64_t bounces = 0;
  for (auto _ : state) {
    PathTask task;
    task.scene = &scene.view();
    task.camera = {0, 0, 16, 16, 0, 16, 1, SamplerKind::sobol, 0};
    task.settings = {32, 64, false, DirectLight::weighted};
    task.radiance = radiance.data();
    task.scratch = scratch.data();
    kernels.path.trace(task);
    bounces += task.counts.bounce;
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(bounces));
}
BENCHMARK_CAPTURE(shade, diffuse, DiffuseDescription{RgbD(0.9)});
BENCHMARK_CAPTURE(shade, mirror, ConductorDescription{});
BENCHMARK_CAPTURE(shade, gold, ConductorDescription{ComplexIor{{0.14, 0.37, 1.44}, {4, 2.4, 1.6}}, RgbD(1)});
BENCHMARK_CAPTURE(shade, glass, DielectricDescription{});

}  // namespace
}  // namespace photonproof::inline renderer_lanes
