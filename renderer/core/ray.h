// Where a single ray ends, for the host's own few rays; the kernels have packs of them.
#pragma once

#include <cstdint>

#include "scenes/base/vec.h"

namespace photonproof::inline renderer_core {

/// Of a shadow segment, how far things are in the way: what a light lies on does not hide it.
inline constexpr float segment_end = 1 - 0x1p-18f;

inline constexpr std::uint32_t no_index = 0xFFFFFFFFu;

/// A light's face that rays of a tracer leave, where those of a small scene name their primitive: this bit and its
/// number among all such faces (surface.h). Rays that end on it say so by another bit.
inline constexpr std::uint32_t light_face = 0x80000000u, light_at_end = 0x40000000u;

struct Hit {
  std::uint32_t surface = no_index;  ///< index into Scene::surfaces; no_index on a miss
  Vec3f p_world;                     ///< on the surface up to rounding
  Vec3f normal;                      ///< unit, geometric, on the side the scene file says (flip_normals applied)
  bool valid() const { return surface != no_index; }
};

}  // namespace photonproof::inline renderer_core
