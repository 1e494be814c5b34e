// Unbiased Russian roulette on a throughput.
#pragma once

#include <algorithm>

#include "renderer/sampler.h"

namespace photonproof {

/// Survives with probability min(0.95, largest channel) and divides by it; false when the history ends.
/// `throughput_scale` undoes what refraction did to the throughput (the squared ratio of indices).
inline bool survives_roulette(Rgb& throughput, float throughput_scale, Sampler& sampler) {
  const float q = std::min(0.95f, max_component(throughput) * throughput_scale);
  if (!(sampler.next() < q)) return false;
  throughput *= 1 / q;
  return true;
}

}  // namespace photonproof
