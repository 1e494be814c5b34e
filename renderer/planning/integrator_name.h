// Integrators by the names that scene files use.
#pragma once

#include <string>

#include "scenes/description/description.h"

namespace photonproof::inline renderer_planning {

/// The name of the integrator in a scene file.
std::string integrator_name(const IntegratorDescription& description);
/// The same request for another integrator: it keeps path depth, roulette depth and hidden emitters, and has the
/// defaults of all other parameters. Throws InputError when a scene file may not use `name`.
IntegratorDescription with_integrator(const IntegratorDescription& description, const std::string& name);

}  // namespace photonproof::inline renderer_planning
