// The random numbers of one path, each identified by the decision that it serves.
#pragma once

#include "renderer/lanes/sampler.h"

namespace photonproof::inline renderer_lanes {

struct PathSampler {
  SamplerKind kind = SamplerKind::sobol;
  std::uint32_t key = 0;    ///< of the path's sequence
  std::uint32_t index = 0;  ///< the path's number in it

  /// Uniform in [0,1).
  float one(std::uint32_t dimension) const { return draw_independent<float>(key, index, dimension); }
  /// Uniform in [0,1)^2, stratified over the sequence's paths where the sampler stratifies.
  Vec2<float> two(std::uint32_t dimension) const { return draw2<float>(kind, key, index, dimension); }
};

/// The sampler of path `number` of a whole render. All paths are in one sequence, stratified against each other.
inline PathSampler sampler_of_path(SamplerKind kind, std::uint64_t seed, Stream stream, std::uint64_t number) {
  return {kind, stream_seed(seed, stream, number >> 32), static_cast<std::uint32_t>(number)};
}

}  // namespace photonproof::inline renderer_lanes
