// Notes on parts of a scene that are rendered differently from the file: values rendered as others, dark lights,
// triangles without area.
#pragma once

#include <vector>

#include "renderer/scene/scene_parts.h"
#include "scenes/description/scene_note.h"

namespace photonproof::inline renderer_limits {

/// First the description's own notes. Then BSDFs, shapes and emitters in its order, and last what is too near or far
/// for precision. `scene` is compiled from it.
std::vector<SceneNote> scene_notes(const SceneDescription& description, const SceneParts& scene);

}  // namespace photonproof::inline renderer_limits
