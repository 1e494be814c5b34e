// Shapes as Blender's objects: each mesh is made once and shared, each object has its own place.
#pragma once

#include "reference/cycles/cycles_script.h"

namespace photonproof::inline reference_cycles {

/// The scene's shapes and their materials. Throws NotRepresentable.
void write_shapes(CyclesScript& script);

}  // namespace photonproof::inline reference_cycles
