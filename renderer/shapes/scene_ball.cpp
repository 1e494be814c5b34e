#include "renderer/shapes/scene_ball.h"

#include <cmath>

namespace photonproof::inline renderer_shapes {

std::vector<ShapeBox> boxes_around(const std::vector<Surface>& surfaces) {
  std::vector<ShapeBox> boxes;
  boxes.reserve(surfaces.size());
  for (const Surface& surface : surfaces)
    boxes.push_back(std::visit([](const auto& shape) { return box_around(shape); }, surface.geometry));
  return boxes;
}

SceneBall scene_ball(const std::vector<ShapeBox>& boxes) {
  ShapeBox box;
  for (const ShapeBox& of_surface : boxes) box.add(of_surface);
  constexpr float margin = 1 + 1e-4f;  // what rounding could leave outside
  const float radius = length(box.high - box.low) * 0.5f * margin;
  if (!(radius > 0) || !std::isfinite(radius)) return {};
  return {(box.low + box.high) * 0.5f, radius};
}

}  // namespace photonproof::inline renderer_shapes
