// The `path` integrator: the project's unbiased reference.
#pragma once

#include "renderer/kernels/tasks.h"
#include "renderer/passes/render_job.h"
#include "renderer/planning/planner.h"
#include "renderer/scene/scene.h"
#include "renderer/sensor/film.h"

namespace photonproof::inline renderer_integrators {

/// Runs the passes of the path kernel with these settings.
void trace_path_passes(const Scene& scene, const PathSettings& settings, const RenderJob& job, const std::string& phase,
                       Film& film, RenderStats& stats);

void plan_path(const IntegratorDescription& description, Planner& planner);
void render_path(const Scene& scene, const RenderPlan& plan, const RenderJob& job, Film& film, RenderStats& stats);

}  // namespace photonproof::inline renderer_integrators
