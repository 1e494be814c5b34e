// A scene's content as a few digits: checkpoints and references belong to one content.
#pragma once

#include <string>
#include <vector>

#include "scenes/description/description.h"

namespace photonproof::inline scenes_description {

/// Hash of the scene's content: the bytes of its XML files, the values given to its $names, and the meshes, images and
/// profiles that were read. The files' folders do not matter.
std::string scene_hash(const SceneDescription& scene);

}  // namespace photonproof::inline scenes_description
