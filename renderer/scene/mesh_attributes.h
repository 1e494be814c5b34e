// Checks that surfaces have the mesh attributes that their textures name.
#pragma once

#include <vector>

#include "renderer/bsdfs/bsdf_table.h"
#include "renderer/shapes/surface.h"
#include "renderer/textures/texture.h"
#include "scenes/description/description.h"

namespace photonproof::inline renderer_scene {

/// Throws InputError at a shape whose mesh lacks an attribute that its BSDF shows, or has values of it outside 0 to 1.
/// Also throws where an attribute cannot be shown. `shape_of` has the shape of each surface.
void check_mesh_attributes(const SceneDescription& description, const Textures& textures, const BsdfTable& bsdfs,
                           const std::vector<Surface>& surfaces, const std::vector<const ShapeDescription*>& shape_of);

}  // namespace photonproof::inline renderer_scene
