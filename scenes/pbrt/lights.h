// pbrt's light sources and media.
#pragma once

#include "scenes/pbrt/textures.h"

namespace photonproof::inline scenes_pbrt {

/// The directive LightSource. Throws InputError.
void add_pbrt_light(PbrtContext& context, const PbrtEntity& light);

/// The directive MakeNamedMedium. Throws InputError.
void add_pbrt_medium(PbrtContext& context, const std::string& name, const PbrtParameters& parameters);

}  // namespace photonproof::inline scenes_pbrt
