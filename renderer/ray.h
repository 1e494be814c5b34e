// Rays and where they end.
#pragma once

#include <cstdint>
#include <limits>

#include "scenes/vec.h"

namespace photonproof {

struct Ray {
  Vec3f origin;
  Vec3f direction;  ///< unit for path segments; unnormalised for shadow segments, where t runs from 0 to 1
  float t_near = 0;
  float t_far = std::numeric_limits<float>::infinity();
};

inline constexpr std::uint32_t no_index = 0xFFFFFFFFu;

struct Hit {
  std::uint32_t surface = no_index;  ///< index into Scene::surfaces; no_index on a miss
  Vec3f p_world;                     ///< on the surface up to rounding
  Vec3f normal;                      ///< unit, geometric, on the side the scene file says (flip_normals applied)
  bool valid() const { return surface != no_index; }
};

}  // namespace photonproof
