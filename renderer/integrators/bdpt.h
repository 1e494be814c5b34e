// The `bdpt` integrator: bidirectional path tracing.
#pragma once

#include "renderer/lanes/sampler.h"
#include "renderer/passes/render_job.h"
#include "renderer/planning/planner.h"
#include "renderer/scene/scene.h"
#include "renderer/sensor/film.h"

namespace photonproof::inline renderer_integrators {

inline constexpr Stream bdpt_stream{6};  ///< of camera paths; light paths use ptracer's
/// The stream of light paths beside camera paths of a filter's negative lobes.
inline constexpr Stream bdpt_negative_stream{27};

void plan_bdpt(const IntegratorDescription& description, Planner& planner);
void render_bdpt(const Scene& scene, const RenderPlan& plan, const RenderJob& job, Film& film, RenderStats& stats);

}  // namespace photonproof::inline renderer_integrators
