// What an integrator cannot do is refused before anything is rendered: never a wrong picture.
#pragma once

#include "renderer/integrators/integrator.h"
#include "scenes/description/description.h"

namespace photonproof::inline renderer_integrators {

/// Throws InputError at the entity of the scene that the integrator of `method` would get wrong, naming one that does
/// not, or when this program has no such integrator.
void check_supported(const SceneDescription& description, const IntegratorDescription& method);

/// Throws InputError naming the option when the job asks for what the integrator does not heed.
void check_job(const RenderJob& job, const IntegratorDescription& method);

}  // namespace photonproof::inline renderer_integrators
