// Lights that are no surfaces, and the medium around everything.
#pragma once

#include "reference/cycles/cycles_script.h"

namespace photonproof::inline reference_cycles {

/// Throws NotRepresentable for what Blender 3.4 has no equal of.
void write_lights(CyclesScript& script);

}  // namespace photonproof::inline reference_cycles
