// Surfaces as POV-Ray objects.
#pragma once

#include "reference/povray_plan.h"
#include "reference/sdl_text.h"

namespace photonproof {

/// One object a surface. A light that is seen and also reflects becomes two objects in one place, see the comments the
/// text carries.
void write_surfaces(const PovScene& scene, const PovPlan& plan, SdlWriter& out);

}  // namespace photonproof
