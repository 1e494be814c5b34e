// pbrt's media: the same everywhere, or in a grid.
#pragma once

#include <string>

#include "scenes/pbrt/state.h"

namespace photonproof::inline scenes_pbrt {

/// The directive MakeNamedMedium. Throws InputError.
void add_pbrt_medium(PbrtContext& context, const std::string& name, const PbrtEntity& medium);

}  // namespace photonproof::inline scenes_pbrt
