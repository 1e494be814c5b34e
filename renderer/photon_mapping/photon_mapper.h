// The `photonmapper` integrator: global and caustic photon maps of fixed radius.
#pragma once

#include "renderer/passes/render_job.h"
#include "renderer/planning/planner.h"
#include "renderer/scene/scene.h"
#include "renderer/sensor/film.h"

namespace photonproof::inline renderer_photon_mapping {

void plan_photon_mapper(const IntegratorDescription& description, Planner& planner);
void render_photon_mapper(const Scene& scene, const RenderPlan& plan, const RenderJob& job, Film& film,
                          RenderStats& stats);

}  // namespace photonproof::inline renderer_photon_mapping
