// The `direct` integrator: emission and light that is reflected once.
#pragma once

#include "renderer/integrator.h"

namespace photonproof {

void render_direct(const Scene& scene, const IntegratorDescription& description, const RenderJob& job, Film& film,
                   RenderStats& stats);

/// Paths of the kernel for each camera sample asked for: the larger count of DirectDescription. A path takes one sample
/// of a light and one of the BSDF, of which a count of 0 leaves one out; so the smaller of two positive counts is
/// raised to the larger, and each of a camera sample's light samples has a ray of its own through the pixel.
std::int64_t paths_a_sample(const DirectDescription& description);

}  // namespace photonproof
