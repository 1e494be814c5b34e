// How many paths a camera sample of the `direct` integrator is.
#pragma once

#include <algorithm>
#include <cstdint>

#include "scenes/description/description.h"

namespace photonproof::inline renderer_planning {

/// Paths of the kernel for each camera sample asked for: the larger count of DirectDescription. A path takes one sample
/// of a light and one of the BSDF, of which a count of 0 leaves one out; so the smaller of two positive counts is
/// raised to the larger, and each of a camera sample's light samples has a ray of its own through the pixel.
inline std::int64_t paths_a_sample(const DirectDescription& description) {
  return std::max(description.emitter_samples, description.bsdf_samples);
}

}  // namespace photonproof::inline renderer_planning
