// The `whitted` integrator: classical ray tracing.
#pragma once

#include "renderer/lanes/sampler.h"
#include "renderer/passes/render_job.h"
#include "renderer/planning/planner.h"
#include "renderer/scene/scene.h"
#include "renderer/sensor/film.h"

namespace photonproof::inline renderer_integrators {

inline constexpr Stream whitted_stream{8};

void plan_whitted(const IntegratorDescription& description, Planner& planner);
void render_whitted(const Scene& scene, const RenderPlan& plan, const RenderJob& job, Film& film, RenderStats& stats);

}  // namespace photonproof::inline renderer_integrators
