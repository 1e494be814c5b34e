// The ball around a scene, which light from infinity enters it through.
#pragma once

#include <vector>

#include "renderer/scene_lights.h"
#include "renderer/surface.h"

namespace photonproof {

/// Holds all surfaces but infinite ones. With none, radius 1 around the origin.
SceneBall scene_ball(const std::vector<Surface>& surfaces);

}  // namespace photonproof
