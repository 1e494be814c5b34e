// Notes on parts of a scene that are rendered differently from the file: values rendered as others, dark lights,
// triangles without area.
#pragma once

#include <string>
#include <vector>

#include "renderer/scene/scene_parts.h"

namespace photonproof::inline renderer_limits {

struct SceneNote {
  std::string where;  ///< file:line:col
  std::string text;   ///< a sentence without its full stop
};

/// In the order of the description: BSDFs, shapes, emitters; then what is too near or far for precision. `scene` is
/// compiled from it.
std::vector<SceneNote> scene_notes(const SceneDescription& description, const SceneParts& scene);

}  // namespace photonproof::inline renderer_limits
