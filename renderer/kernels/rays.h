// Ray queries of a pack: the small scene's kernel or Embree.
#pragma once

#include "renderer/kernels/small_scene.h"
#include "renderer/trace.h"

namespace photonproof {

template <class F>
void fill_block(RayBlock& block, const Vec3<F>& origin, const Vec3<F>& direction, const Mask<F>& active) {
  const auto put = [](const F& v, float* to) { store_from(v, reinterpret_cast<std::uint32_t*>(to)); };
  put(origin.x, block.origin_x);
  put(origin.y, block.origin_y);
  put(origin.z, block.origin_z);
  put(direction.x, block.direction_x);
  put(direction.y, block.direction_y);
  put(direction.z, block.direction_z);
  block.active = to_bits(active);
}

/// Closest hits of the active lanes; directions are unit. `coherent`: neighbours in the pack go the same way.
template <class F>
SurfaceHit<F> closest_hit(const SceneView& scene, const Vec3<F>& origin, const Vec3<F>& direction, const UInt<F>& from,
                          const Mask<F>& active, bool coherent) {
  if (scene.small) {
    SurfaceHit<F> hit = closest_small(scene.primitives, origin, direction, from);
    hit.valid = hit.valid && active;
    return hit;
  }
  RayBlock rays{};
  HitBlock hits{};
  fill_block(rays, origin, direction, active);
  scene.tracer->intersect(rays, hits, coherent);
  SurfaceHit<F> hit;
  const auto get = [](const float* from_block) { return load(from_block, F()); };
  hit.p = {get(hits.p_x), get(hits.p_y), get(hits.p_z)};
  hit.normal = {get(hits.normal_x), get(hits.normal_y), get(hits.normal_z)};
  load_into(hit.surface, hits.surface);
  hit.valid = active && !equal<F>(hit.surface, UInt<F>(no_index));
  hit.surface = select(hit.valid, hit.surface, UInt<F>(0u));
  hit.primitive = UInt<F>(no_index);
  return hit;
}

/// Where something lies between `origin` and origin + segment, of the active lanes.
template <class F>
Mask<F> occluded(const SceneView& scene, const Vec3<F>& origin, const Vec3<F>& segment, const UInt<F>& from,
                 const UInt<F>& target, const Mask<F>& active) {
  if (scene.small) return active && occluded_small(scene.primitives, origin, segment, from, target);
  RayBlock rays{};
  fill_block(rays, origin, segment, active);
  std::uint32_t blocked[RayBlock::width];
  scene.tracer->occluded(rays, blocked);
  UInt<F> words;
  load_into(words, blocked);
  return active && equal<F>(words, UInt<F>(1u));
}

}  // namespace photonproof
