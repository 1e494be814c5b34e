// Rays by kind and scene size. The path tracer end to end against its own rays through Embree alone. The scene size at
// which the packed kernel stops paying off (brute_force_limit). All on one thread; items are rays.
//   ./run --bench rays

#include <benchmark/benchmark.h>

#include <map>
#include <utility>

#include "renderer/kernels/isa.h"
#include "renderer/kernels/test_bench_scenes.h"
#include "renderer/kernels/test_recorded_rays.h"

namespace photonproof::inline renderer_kernels {
namespace {

constexpr int max_depth = 8;

const bench::RecordedRays& rays_of(const std::string& name, bool embree) {
  static std::map<std::string, bench::RecordedRays> recorded;
  auto& rays = recorded[name];
  if (rays.camera.empty()) rays = bench::record_rays(bench::scene(name, embree), 4, max_depth);
  return rays;
}

/// The whole image, `samples` a pixel; returns the rays traced.
std::uint64_t trace_image(const Scene& scene, const Kernels& kernels, std::uint32_t samples) {
  std::uint64_t rays = 0;
  std::vector<std::uint32_t> scratch(kernels.path.scratch);
  for (int y = 0; y < scene.height; y += 16) {
    for (int x = 0; x < scene.width; x += 16) {
      PathTask task;
      task.scene = &scene.view();
      task.camera = {x, y, x + 16, y + 16, 0, samples, 1, SamplerKind::sobol, 0};
      task.settings.max_depth = max_depth;
      if (!scene.view().lights_can_be_hit) task.settings.direct_light = DirectLight::unweighted;
      std::vector<float> radiance(3 * std::size_t{task.camera.paths()});
      task.radiance = radiance.data();
      task.scratch = scratch.data();
      kernels.path.trace(task);
      benchmark::DoNotOptimize(radiance.data());
      rays += task.counts.camera + task.counts.bounce + task.counts.shadow;
    }
  }
  return rays;
}

void path_tracer(benchmark::State& state, const std::string& name, const std::string& isa, bool embree) {
  const Scene& scene = bench::scene(name, embree);
  std::uint64_t rays = 0;
  for (auto _ : state) rays += trace_image(scene, kernels_for(isa), 4);
  state.SetItemsProcessed(static_cast<std::int64_t>(rays));
}

using Alone = Tracer::Alone;

/// `packets`: rays go sixteen at a time, camera rays as neighbours.
void rays_alone(benchmark::State& state, const std::string& name, bool packets) {
  const Scene& scene = bench::scene(name, true);
  const bench::RecordedRays& rays = rays_of(name, true);
  const Alone how = packets ? Alone::as_packets : Alone::one_by_one;
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        scene.view().tracer->count_hits_alone(rays.camera, packets ? Alone::as_neighbours : Alone::one_by_one));
    benchmark::DoNotOptimize(scene.view().tracer->count_hits_alone(rays.bounce, how));
    benchmark::DoNotOptimize(scene.view().tracer->count_occluded_alone(rays.shadow, how));
  }
  const std::size_t count = rays.count(rays.camera) + rays.count(rays.bounce) + rays.count(rays.shadow);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(count));
}

enum class Kind { camera, bounce, shadow };

const std::vector<RayBlock>& blocks_of(const std::string& name, Kind kind) {
  const bench::RecordedRays& rays = rays_of(name, true);
  return kind == Kind::shadow ? rays.shadow : kind == Kind::camera ? rays.camera : rays.bounce;
}

/// Queries as the kernels make them, through Embree. Only camera rays are neighbours.
void query(benchmark::State& state, const std::string& name, Kind kind) {
  const Scene& scene = bench::scene(name, true);
  const std::vector<RayBlock>& blocks = blocks_of(name, kind);
  HitBlock hits;
  std::uint32_t blocked[RayBlock::width];
  for (auto _ : state) {
    for (const RayBlock& block : blocks) {
      if (kind == Kind::shadow)
        scene.view().tracer->occluded(block, blocked);
      else
        scene.view().tracer->intersect(block, hits, kind == Kind::camera);
      benchmark::DoNotOptimize(hits);
      benchmark::DoNotOptimize(blocked);
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(rays_of(name, true).count(blocks)));
}

/// Rays of one kind through Embree alone.
void kind_alone(benchmark::State& state, const std::string& name, Kind kind, Alone how) {
  const Scene& scene = bench::scene(name, true);
  const std::vector<RayBlock>& blocks = blocks_of(name, kind);
  for (auto _ : state)
    benchmark::DoNotOptimize(kind == Kind::shadow ? scene.view().tracer->count_occluded_alone(blocks, how)
                                                  : scene.view().tracer->count_hits_alone(blocks, how));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(rays_of(name, true).count(blocks)));
}

/// Path tracing among random parallelograms, through the packed kernel or through Embree: where they cross is
/// brute_force_limit.
void threshold(benchmark::State& state, int plates, const std::string& isa, bool embree) {
  const std::unique_ptr<Scene> scene = bench::random_plates(plates, embree);
  std::uint64_t rays = 0;
  for (auto _ : state) rays += trace_image(*scene, kernels_for(isa), 4);
  state.SetItemsProcessed(static_cast<std::int64_t>(rays));
}

int register_all() {
  const auto add = [](const std::string& name, auto&& body) {
    benchmark::RegisterBenchmark(name.c_str(), body)->Unit(benchmark::kMillisecond);
  };
  for (const std::string scene : {"cornell", "cornell-spheres", "million:10000", "million:1000000"}) {
    add("path_tracer/ours/" + scene, [scene](benchmark::State& s) { path_tracer(s, scene, "", false); });
    add("path_tracer/embree_alone/" + scene, [scene](benchmark::State& s) { rays_alone(s, scene, false); });
    add("path_tracer/embree_packets/" + scene, [scene](benchmark::State& s) { rays_alone(s, scene, true); });
    for (const auto& [what, kind] :
         {std::pair{"camera", Kind::camera}, {"bounce", Kind::bounce}, {"shadow", Kind::shadow}}) {
      const std::string rays = "rays/" + scene + "/" + what;
      add(rays + "/ours", [scene, kind](benchmark::State& s) { query(s, scene, kind); });
      for (const auto& [name, how] : {std::pair{"single", Alone::one_by_one},
                                      {"packet", Alone::as_packets},
                                      {"neighbours", Alone::as_neighbours}})
        if (kind != Kind::shadow || how != Alone::as_neighbours)
          add(rays + "/" + name, [scene, kind, how](benchmark::State& s) { kind_alone(s, scene, kind, how); });
    }
  }
  add("path_tracer/ours/million:10000000", [](benchmark::State& s) { path_tracer(s, "million:10000000", "", false); });
  for (const Kernels& kernels : available_kernels()) {
    const std::string isa = kernels.isa;
    add("isa/" + isa, [isa](benchmark::State& s) { path_tracer(s, "cornell", isa, false); });
  }
  for (const Kernels& kernels : available_kernels()) {
    const std::string isa = kernels.isa;
    for (const int plates : {16, 32, 64, 128, 256}) {
      const std::string name = "threshold/" + isa + "/" + std::to_string(plates);
      add(name + "/kernel", [plates, isa](benchmark::State& s) { threshold(s, plates, isa, false); });
      add(name + "/embree", [plates, isa](benchmark::State& s) { threshold(s, plates, isa, true); });
    }
  }
  return 0;
}

const int registered = register_all();

}  // namespace
}  // namespace photonproof::inline renderer_kernels
