// What a checkpoint must have in common with the render that goes on from it: everything that decides a bit.
#pragma once

#include <string>
#include <vector>

#include "renderer/checkpoint.h"
#include "scenes/description.h"

namespace photonproof {

/// Hash of what the scene says: the bytes of its XML files, the values given to its $names, and the meshes, images and
/// profiles that were read. Where the files lie does not matter.
std::string scene_hash(const SceneDescription& scene, std::vector<std::string> defines);

}  // namespace photonproof
