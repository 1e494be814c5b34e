// BSDFs as POV-Ray textures.
#pragma once

#include "reference/povray/povray_plan.h"
#include "reference/povray/sdl_text.h"

namespace photonproof::inline reference_povray {

/// Declares texture Bsdf_<i> (and Interior_<i> for glass) for each side that a surface has, over the plane of uv where
/// it is textured, and the textures of backs: Black, of one-sided surfaces, and Clear, of those the near plane cuts
/// away and where nothing is.
void write_materials(const PovScene& scene, const PovPlan& plan, SdlWriter& out);

/// The name of a side's texture, and where it lies on the surface: what is between "texture{" and "}".
std::string placed_texture(const PovScene& scene, const PovSurface& surface, const BsdfDescription& side,
                           const PovPlan& plan);

/// " texture{...} interior_texture{...}" of a surface, and an interior where its inside differs from the air.
std::string material_of(const PovScene& scene, const PovSurface& surface, const PovPlan& plan);

/// The same of a light's front: " texture{...}" that both shines and reflects.
std::string light_texture(const PovScene& scene, const PovSurface& surface, const PovPlan& plan);

/// What is behind: " interior_texture{...}" of a surface that lets nothing through, and its interior.
std::string back_of(const PovScene& scene, const PovSurface& surface, const PovPlan& plan);

}  // namespace photonproof::inline reference_povray
