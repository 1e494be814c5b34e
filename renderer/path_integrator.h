// The `path` integrator: the project's unbiased reference.
#pragma once

#include "renderer/integrator.h"

namespace photonproof {

void render_path(const Scene& scene, const IntegratorDescription& description, const RenderJob& job, Film& film,
                 RenderStats& stats);

}  // namespace photonproof
