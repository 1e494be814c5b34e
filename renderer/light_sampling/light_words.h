// A light's entry in the table for choosing lights (light_table.h), for kernels to gather.
#pragma once

#include <cstdint>

namespace photonproof::inline renderer_light_sampling {

struct LightWords {
  std::uint32_t kind;
  float probability;      ///< probability of being chosen
  float alias_threshold;  ///< alias method (Vose 1991): below it the light itself, above it `alias`
  std::uint32_t alias;
  std::uint32_t primitive;  ///< small scenes: ignored by its own shadow rays; others: the light's first face (ray.h)
  static constexpr std::uint32_t stride = 5;
};

}  // namespace photonproof::inline renderer_light_sampling
