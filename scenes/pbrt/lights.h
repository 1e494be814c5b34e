// pbrt's light sources.
#pragma once

#include "scenes/pbrt/textures.h"

namespace photonproof::inline scenes_pbrt {

/// The directive LightSource. Throws InputError.
void add_pbrt_light(PbrtContext& context, const PbrtEntity& light);

}  // namespace photonproof::inline scenes_pbrt
