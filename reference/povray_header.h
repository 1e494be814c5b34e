// The head of an exported file: what it is, and POV-Ray's global settings.
#pragma once

#include "reference/povray_plan.h"
#include "reference/sdl_text.h"

namespace photonproof {

void write_header(const PovScene& scene, const PovPlan& plan, SdlWriter& out);

}  // namespace photonproof
