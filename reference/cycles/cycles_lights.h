// Lights without a surface, and the medium around everything.
#pragma once

#include "reference/cycles/cycles_script.h"

namespace photonproof::inline reference_cycles {

/// Throws NotRepresentable for lights that Blender 3.4 has no equivalent of.
void write_lights(CyclesScript& script);

}  // namespace photonproof::inline reference_cycles
