// The `direct` integrator: emission and light reflected once.
#pragma once

#include "renderer/passes/render_job.h"
#include "renderer/planning/planner.h"
#include "renderer/scene/scene.h"
#include "renderer/sensor/film.h"

namespace photonproof::inline renderer_integrators {

void plan_direct(const IntegratorDescription& description, Planner& planner);
void render_direct(const Scene& scene, const RenderPlan& plan, const RenderJob& job, Film& film, RenderStats& stats);

}  // namespace photonproof::inline renderer_integrators
