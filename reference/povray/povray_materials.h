// BSDFs as POV-Ray textures.
#pragma once

#include "reference/povray/povray_plan.h"
#include "reference/povray/sdl_text.h"

namespace photonproof::inline reference_povray {

/// Declares texture Bsdf_<i> (and Interior_<i> for glass) for each side of a surface, over the plane of uv where it is
/// textured. Backs have two more textures: Black for one-sided surfaces, and Clear where the near plane cuts a surface
/// away or nothing is there.
void write_materials(const PovScene& scene, const PovPlan& plan, SdlWriter& out);

/// The name of a side's texture, and its place on the surface: the text between "texture{" and "}".
std::string placed_texture(const PovScene& scene, const PovSurface& surface, const BsdfDescription& side,
                           const PovPlan& plan);

/// " texture{...} interior_texture{...}" of a surface, and an interior where its inside differs from the air.
std::string material_of(const PovScene& scene, const PovSurface& surface, const PovPlan& plan);

/// The same for a light's front: a " texture{...}" that both emits and reflects.
std::string light_texture(const PovScene& scene, const PovSurface& surface, const PovPlan& plan);

/// The back, " interior_texture{...}", of a surface that transmits nothing, and its interior.
std::string back_of(const PovScene& scene, const PovSurface& surface, const PovPlan& plan);

}  // namespace photonproof::inline reference_povray
