// The `volpath` integrator: path tracing through participating media and nested dielectrics.
#pragma once

#include "renderer/passes/render_job.h"
#include "renderer/scene/scene.h"
#include "renderer/sensor/film.h"

namespace photonproof {

void render_volpath(const Scene& scene, const IntegratorDescription& description, const RenderJob& job, Film& film,
                    RenderStats& stats);

}  // namespace photonproof
