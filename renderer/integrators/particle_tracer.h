// The `ptracer` integrator: light tracing.
#pragma once

#include "renderer/lanes/sampler.h"
#include "renderer/passes/render_job.h"
#include "renderer/planning/planner.h"
#include "renderer/scene/scene.h"
#include "renderer/sensor/film.h"

namespace photonproof::inline renderer_integrators {

inline constexpr Stream ptracer_stream{5};

void plan_particle_tracer(const IntegratorDescription& description, Planner& planner);
void render_particle_tracer(const Scene& scene, const RenderPlan& plan, const RenderJob& job, Film& film,
                            RenderStats& stats);

}  // namespace photonproof::inline renderer_integrators
