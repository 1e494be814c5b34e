// Surfaces as POV-Ray objects.
#pragma once

#include "reference/povray/povray_plan.h"
#include "reference/povray/sdl_text.h"

namespace photonproof::inline reference_povray {

/// The surfaces as the camera, mirrors, glass and shadows meet them; `clip` cuts those that the camera's planes cut.
void write_surfaces(const PovScene& scene, const PovPlan& plan, const std::string& clip, SdlWriter& out);

/// Whether a surface has a twin for radiosity's rays: diffuse surfaces lit by light_sources, and lights that
/// light_sources replace. The rays see only the twin, so fewer points can light it, and it does not emit light that
/// light_sources already add.
bool has_twin(const PovSurface& surface, const PovPlan& plan);

/// The twins; they belong in a light_group with their own lights.
void write_twins(const PovScene& scene, const PovPlan& plan, SdlWriter& out);

}  // namespace photonproof::inline reference_povray
