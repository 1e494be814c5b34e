// What the camera looks at: where in the scene, and how large what it sees there is. Single precision belongs there.
#pragma once

#include <optional>

#include "scenes/description/description.h"

namespace photonproof::inline renderer_scene {

struct SceneFocus {
  Vec3d point;  ///< in the description's coordinates
  double size;  ///< of what is seen around there: never 0
};

/// Shapes in view (all shapes, if none is) count by how near the camera comes to them, and only by their part that it
/// comes near to: a sun, a light or a mountain far away does not count beside the table in front, and of a floor
/// without end counts what lies at the camera's feet. Medians, so that no few of a kind decide. Empty without shapes.
std::optional<SceneFocus> scene_focus(const SceneDescription& description);

}  // namespace photonproof::inline renderer_scene
