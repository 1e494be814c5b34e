// The head of an exported file: its description, and POV-Ray's global settings.
#pragma once

#include "reference/povray/povray_plan.h"
#include "reference/povray/sdl_text.h"

namespace photonproof::inline reference_povray {

void write_header(const PovScene& scene, const PovPlan& plan, SdlWriter& out);

}  // namespace photonproof::inline reference_povray
