// The number of paths per camera sample of the `direct` integrator.
#pragma once

#include <algorithm>
#include <cstdint>

#include "scenes/description/description.h"

namespace photonproof::inline renderer_planning {

/// Paths of the kernel for each requested camera sample: the larger count of DirectDescription. A path takes one sample
/// of a light and one of the BSDF; a count of 0 leaves one out. So the smaller of two positive counts is raised to the
/// larger, and each light sample of a camera sample has its own ray through the pixel.
inline std::int64_t paths_a_sample(const DirectDescription& description) {
  return std::max(description.emitter_samples, description.bsdf_samples);
}

}  // namespace photonproof::inline renderer_planning
