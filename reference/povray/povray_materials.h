// BSDFs as POV-Ray textures.
#pragma once

#include "reference/povray/povray_plan.h"
#include "reference/povray/sdl_text.h"

namespace photonproof {

/// Declares texture Bsdf_<i> (and Interior_<i> for glass) for each BSDF a surface uses, and the textures of backs:
/// Black, of one-sided surfaces, and Clear, of those the near plane cuts away.
void write_materials(const PovScene& scene, SdlWriter& out);

/// Index of a BSDF in SceneDescription::bsdfs: the <i> of its texture.
std::size_t bsdf_number(const PovScene& scene, const PovSurface& surface);

}  // namespace photonproof
