// The ball around a scene, through which light from infinity enters it.
#pragma once

#include <vector>

#include "renderer/shapes/surface.h"

namespace photonproof::inline renderer_shapes {

/// A ball that encloses a scene.
struct SceneBall {
  Vec3f center;
  float radius = 1;
};

/// Around each surface; empty around infinite ones.
std::vector<ShapeBox> boxes_around(const std::vector<Surface>& surfaces);
/// Encloses all boxes. With none, radius 1 around the origin.
SceneBall scene_ball(const std::vector<ShapeBox>& boxes);

}  // namespace photonproof::inline renderer_shapes
