// File names in a description: of meshes, textures and lights.
#pragma once

#include <functional>
#include <string>

#include "scenes/description/description.h"

namespace photonproof::inline scenes_description {

/// Calls `visit` with each name, as the scene spells it, relative to the folder of `scene.files.front()`; it may change
/// it.
void visit_file_names(SceneDescription& scene, const std::function<void(std::string&)>& visit);

/// The same scene with absolute names, for a copy of its text in another folder.
SceneDescription with_absolute_files(SceneDescription scene);

}  // namespace photonproof::inline scenes_description
