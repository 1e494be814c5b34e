// The `volprim_rf_basic` integrator: a radiance field of ellipsoids with opacities and spherical harmonics.
#pragma once

#include "renderer/lanes/sampler.h"
#include "renderer/passes/render_job.h"
#include "renderer/planning/planner.h"
#include "renderer/scene/scene.h"
#include "renderer/sensor/film.h"

namespace photonproof::inline renderer_integrators {

inline constexpr Stream radiance_field_stream{29};

void plan_radiance_field(const IntegratorDescription& description, Planner& planner);
void render_radiance_field(const Scene& scene, const RenderPlan& plan, const RenderJob& job, Film& film,
                           RenderStats& stats);

}  // namespace photonproof::inline renderer_integrators
