// The `volpath` integrator: path tracing through participating media and nested dielectrics.
#pragma once

#include "renderer/lanes/sampler.h"
#include "renderer/passes/render_job.h"
#include "renderer/planning/planner.h"
#include "renderer/scene/scene.h"
#include "renderer/sensor/film.h"

namespace photonproof::inline renderer_integrators {

inline constexpr Stream volpath_stream{7};

void plan_volpath(const IntegratorDescription& description, Planner& planner);
void render_volpath(const Scene& scene, const RenderPlan& plan, const RenderJob& job, Film& film, RenderStats& stats);

}  // namespace photonproof::inline renderer_integrators
