// Refuses scenes with an object inside a body of glass.
#pragma once

#include "reference/povray/povray_scene.h"

namespace photonproof::inline reference_povray {

/// POV-Ray traces refracted rays without scaling radiance by the squared index. The factor cancels between entering and
/// leaving, so glass is right as long as light, eye and other surfaces are all outside.
/// Throws Unrepresentable when a surface, a point light or the camera is inside a dielectric, or cuts into one.
void refuse_overlaps_with_glass(const PovScene& scene);

}  // namespace photonproof::inline reference_povray
