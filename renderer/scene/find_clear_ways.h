// Fills ClearWays.
#pragma once

#include "renderer/light_sampling/clear_ways.h"
#include "renderer/scene/scene_parts.h"

namespace photonproof::inline renderer_scene {

ClearWays find_clear_ways(const SceneParts& scene);

}  // namespace photonproof::inline renderer_scene
