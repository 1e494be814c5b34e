// Turns the description of a BSDF into the record that kernels gather. Parameters that a texture gives are left at 0.5
// in the record and listed as slots: code at the hit point writes the texture's values there. The record's methods
// compute everything that depends on such a parameter (roughness limits, lobe probabilities) from the value.
#pragma once

#include <vector>

#include "renderer/bsdfs/bsdf.h"
#include "renderer/textures/texture_slot.h"
#include "scenes/description/description.h"

namespace photonproof::inline renderer_bsdfs {

struct CompiledBsdf {
  Bsdf record;
  std::vector<TextureSlot> slots;
};

/// Whether a leaf changes when it is turned about its normal, and so needs the tangent along dp/du.
bool is_anisotropic(const SceneDescription& scene, BsdfIndex bsdf);

/// Throws InputError where parameters cannot work together or the BSDF is no leaf.
CompiledBsdf compile_bsdf(const SceneDescription& scene, BsdfIndex bsdf);

}  // namespace photonproof::inline renderer_bsdfs
