// Shapes as Blender's objects: meshes that are made once and shared, each in its place.
#pragma once

#include "reference/cycles/cycles_script.h"

namespace photonproof::inline reference_cycles {

/// The scene's shapes and what they are made of. Throws NotRepresentable.
void write_shapes(CyclesScript& script);

}  // namespace photonproof::inline reference_cycles
