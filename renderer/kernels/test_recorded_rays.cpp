#define PHOTONPROOF_PACKS
#include "renderer/kernels/test_recorded_rays.h"

#include <bit>

// A one-lane pack is a type of its own. The queries below are exact matches for it, so the path kernel prefers them to
// the templates in rays/rays.h.
#include "renderer/rays/rays.h"

namespace photonproof::inline renderer_kernels {

using RecordedLane = stdx::simd<float, stdx::simd_abi::scalar>;

namespace {

bench::RecordedRays* recording = nullptr;

void record(std::vector<RayBlock>& blocks, const Vec3<RecordedLane>& origin, const Vec3<RecordedLane>& direction) {
  if (blocks.empty() || blocks.back().active == (1u << RayBlock::width) - 1) blocks.push_back({});
  RayBlock& block = blocks.back();
  const auto lane = static_cast<std::size_t>(std::popcount(block.active));
  block.origin_x[lane] = origin.x[0];
  block.origin_y[lane] = origin.y[0];
  block.origin_z[lane] = origin.z[0];
  block.direction_x[lane] = direction.x[0];
  block.direction_y[lane] = direction.y[0];
  block.direction_z[lane] = direction.z[0];
  block.active |= 1u << lane;
}

}  // namespace

SurfaceHit<RecordedLane> closest_hit(const SceneView& scene, const Vec3<RecordedLane>& origin,
                                     const Vec3<RecordedLane>& direction, const UInt<RecordedLane>& from,
                                     const Mask<RecordedLane>& active, bool first) {
  record(first ? recording->camera : recording->bounce, origin, direction);
  return closest_hit<RecordedLane>(scene, origin, direction, from, active, false);
}

Mask<RecordedLane> occluded(const SceneView& scene, const Vec3<RecordedLane>& origin, const Vec3<RecordedLane>& segment,
                            const UInt<RecordedLane>& from, const UInt<RecordedLane>& target,
                            const Mask<RecordedLane>& active) {
  record(recording->shadow, origin, segment);
  return occluded<RecordedLane>(scene, origin, segment, from, target, active);
}

}  // namespace photonproof::inline renderer_kernels

#include "renderer/kernels/path_kernel.h"

namespace photonproof::bench {

std::size_t RecordedRays::count(const std::vector<RayBlock>& blocks) const {
  std::size_t rays = 0;
  for (const RayBlock& block : blocks) rays += static_cast<std::size_t>(std::popcount(block.active));
  return rays;
}

RecordedRays record_rays(const Scene& scene, int samples, int max_depth) {
  using Kernel = PathKernel<RecordedLane, PathTracing>;
  RecordedRays rays;
  recording = &rays;
  for (int y = 0; y < scene.height; y += 16) {
    for (int x = 0; x < scene.width; x += 16) {
      PathTask task;
      task.scene = &scene.view();
      task.camera = {x, y, x + 16, y + 16, 0, static_cast<std::uint32_t>(samples), 1, SamplerKind::sobol, 0};
      task.settings.max_depth = max_depth;
      if (!scene.view().lights_can_be_hit) task.settings.direct_light = DirectLight::unweighted;
      std::vector<float> radiance(3 * std::size_t{task.camera.paths()});
      std::vector<std::uint32_t> scratch(Kernel::scratch_words);
      task.radiance = radiance.data();
      task.scratch = scratch.data();
      Kernel(task).run(task.camera.paths());
    }
  }
  recording = nullptr;
  return rays;
}

}  // namespace photonproof::bench
