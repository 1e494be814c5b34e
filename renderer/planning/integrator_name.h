// Integrators by name, as scene files ask for them.
#pragma once

#include <string>

#include "scenes/description/description.h"

namespace photonproof::inline renderer_planning {

/// The name of the integrator a scene file asks for.
std::string integrator_name(const IntegratorDescription& description);
/// The same request for another integrator: path depth, roulette depth and hidden emitters are kept, what the scene
/// file does not say takes its default. Throws InputError when a scene file may not use `name`.
IntegratorDescription with_integrator(const IntegratorDescription& description, const std::string& name);

}  // namespace photonproof::inline renderer_planning
