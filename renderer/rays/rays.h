// Ray queries of a pack: the small scene's kernel or Embree.
#pragma once

#include "renderer/rays/brute_force_intersector.h"
#include "renderer/rays/trace.h"

namespace photonproof::inline renderer_rays {

template <class F>
void fill_block(RayBlock& block, const Vec3<F>& origin, const Vec3<F>& direction, const UInt<F>& light,
                const Mask<F>& active) {
  store_from(origin.x, block.origin_x);
  store_from(origin.y, block.origin_y);
  store_from(origin.z, block.origin_z);
  store_from(direction.x, block.direction_x);
  store_from(direction.y, block.direction_y);
  store_from(direction.z, block.direction_z);
  store_from(light, block.light);
  block.active = to_bits(active);
}

/// Closest hits of the active lanes; directions are unit. `from` is as in brute_force_intersector.h; with a tracer it
/// is the light that the rays leave (ray.h). `coherent`: neighbours in the pack have similar directions.
template <class F>
SurfaceHit<F> closest_hit(const RayScene& scene, const Vec3<F>& origin, const Vec3<F>& direction, const UInt<F>& from,
                          const Mask<F>& active, bool coherent) {
  if (scene.small) {
    SurfaceHit<F> hit = closest_small(scene.primitives, origin, direction, from);
    hit.valid = hit.valid && active;
    return hit;
  }
  RayBlock rays;
  HitBlock hits;
  if constexpr (lane_count < F >> 1) {  // packets read the idle lanes too
    rays = {};
    hits = {};
  }
  fill_block(rays, origin, direction, from, active);
  scene.tracer->intersect(rays, hits, coherent);
  SurfaceHit<F> hit;
  load_into(hit.p.x, hits.p_x);
  load_into(hit.p.y, hits.p_y);
  load_into(hit.p.z, hits.p_z);
  load_into(hit.normal.x, hits.normal_x);
  load_into(hit.normal.y, hits.normal_y);
  load_into(hit.normal.z, hits.normal_z);
  load_into(hit.surface, hits.surface);
  hit.valid = active && !equal<F>(hit.surface, UInt<F>(no_index));
  hit.surface = select(hit.valid, hit.surface, UInt<F>(0u));
  load_into(hit.primitive, hits.primitive);
  return hit;
}

/// Whether a surface lies between `origin` and origin + segment, for the active lanes.
template <class F>
Mask<F> occluded(const RayScene& scene, const Vec3<F>& origin, const Vec3<F>& segment, const UInt<F>& from,
                 const UInt<F>& target, const Mask<F>& active) {
  if (scene.small) return active && occluded_small(scene.primitives, origin, segment, from, target);
  RayBlock rays;
  if constexpr (lane_count < F >> 1) rays = {};
  const Mask<F> to_light = as_mask<F>(UInt<F>(target - light_face) < UInt<F>(light_at_end));
  fill_block(rays, origin, segment, UInt<F>(select(to_light, target | light_at_end, from)), active);
  std::uint32_t blocked[RayBlock::width];
  scene.tracer->occluded(rays, blocked);
  UInt<F> words;
  load_into(words, blocked);
  return active && equal<F>(words, UInt<F>(1u));
}

}  // namespace photonproof::inline renderer_rays
