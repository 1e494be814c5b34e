// Refuses scenes where something lies inside a body of glass.
#pragma once

#include "reference/povray/povray_scene.h"

namespace photonproof::inline reference_povray {

/// POV-Ray traces refracted rays without the factor of the squared index that radiance changes by. The factor cancels
/// between entering and leaving, so that glass is right as long as light, eye and other surfaces are all outside.
/// Throws Unrepresentable when a surface, a point light or the camera is inside a dielectric, or cuts into one.
void refuse_overlaps_with_glass(const PovScene& scene);

}  // namespace photonproof::inline reference_povray
