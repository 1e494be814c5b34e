// The camera's focus of attention: the place and size of the visible scene. Single precision is finest there.
#pragma once

#include <optional>

#include "scenes/description/description.h"

namespace photonproof::inline renderer_scene {

struct SceneFocus {
  Vec3d point;  ///< in the description's coordinates
  double size;  ///< of the visible scene around the point: never 0
};

/// Shapes in view (all shapes, if none is) count by the distance at which the camera comes near to them, and only with
/// their part there. So a far sun, light or mountain does not count beside the table in front, and an endless floor
/// counts only at the camera's feet. The result is a median, so that a few shapes do not decide. Empty without shapes.
std::optional<SceneFocus> scene_focus(const SceneDescription& description);

}  // namespace photonproof::inline renderer_scene
