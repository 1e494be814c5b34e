// The end of a single ray, for the host's own few rays; the kernels have packs of them.
#pragma once

#include <cstdint>

#include "scenes/base/vec.h"

namespace photonproof::inline renderer_core {

/// Part of a shadow segment in which surfaces occlude: the surface that a light lies on must not hide it.
inline constexpr float segment_end = 1 - 0x1p-18f;

inline constexpr std::uint32_t no_index = 0xFFFFFFFFu;

/// Marks a tracer's ray that leaves a light's face: this bit and the face's number among all such faces (surface.h).
/// Rays of small scenes name their primitive instead. Another bit marks rays that end on the face.
inline constexpr std::uint32_t light_face = 0x80000000u, light_at_end = 0x40000000u;

struct Hit {
  std::uint32_t surface = no_index;  ///< index into Scene::surfaces; no_index on a miss
  Vec3f p_world;                     ///< on the surface up to rounding
  Vec3f normal;                      ///< unit, geometric, on the side that the scene file states (flip_normals applied)
  bool valid() const { return surface != no_index; }
};

}  // namespace photonproof::inline renderer_core
