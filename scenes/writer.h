// Writes a SceneDescription as scene XML; parse -> write -> parse is the identity (but for source positions).
#pragma once

#include <string>

#include "scenes/description.h"

namespace photonproof {

std::string write_scene(const SceneDescription& scene);

}  // namespace photonproof
