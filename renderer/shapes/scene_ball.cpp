#include "renderer/shapes/scene_ball.h"

#include <cmath>

namespace photonproof {
SceneBall scene_ball(const std::vector<Surface>& surfaces) {
  ShapeBox box;
  for (const Surface& surface : surfaces)
    box.add(std::visit([](const auto& shape) { return box_around(shape); }, surface.geometry));
  constexpr float margin = 1 + 1e-4f;  // what rounding could leave outside
  const float radius = length(box.high - box.low) * 0.5f * margin;
  if (!(radius > 0) || !std::isfinite(radius)) return {};
  return {(box.low + box.high) * 0.5f, radius};
}

}  // namespace photonproof
