// Refuses scenes and jobs that an integrator cannot do before rendering, so that no wrong image results.
#pragma once

#include "renderer/integrators/integrator.h"
#include "scenes/description/description.h"

namespace photonproof::inline renderer_integrators {

/// Throws InputError at the entity of the scene that the integrator of `method` cannot render, and names one that can.
/// Also throws when this program has no such integrator.
void check_supported(const SceneDescription& description, const IntegratorDescription& method);

/// Throws InputError where the job shows photons through something else than a single camera.
void check_view(const SceneDescription& description, const RenderJob& job);

/// Throws InputError with the option's name when the job uses an option that the integrator does not support.
void check_job(const RenderJob& job, const IntegratorDescription& method);

}  // namespace photonproof::inline renderer_integrators
