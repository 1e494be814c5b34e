// The `path` integrator: the project's unbiased reference.
#pragma once

#include "renderer/kernels/tasks.h"
#include "renderer/passes/render_job.h"
#include "renderer/scene/scene.h"
#include "renderer/sensor/film.h"

namespace photonproof {

/// The passes of the path kernel, with these settings.
void trace_path_passes(const Scene& scene, const PathSettings& settings, const RenderJob& job, const std::string& phase,
                       Film& film, RenderStats& stats);

void render_path(const Scene& scene, const IntegratorDescription& description, const RenderJob& job, Film& film,
                 RenderStats& stats);

}  // namespace photonproof
