#include "renderer/shapes/shape.h"

#include <algorithm>
#include <cmath>

namespace photonproof::inline renderer_shapes {

void ShapeBox::add(const Vec3f& p) { add({p, p}); }

void ShapeBox::add(const ShapeBox& other) {
  low = {std::min(low.x, other.low.x), std::min(low.y, other.low.y), std::min(low.z, other.low.z)};
  high = {std::max(high.x, other.high.x), std::max(high.y, other.high.y), std::max(high.z, other.high.z)};
}

ShapeBox padded_box(const Vec3d& low, const Vec3d& high) {
  const double reach = std::max(
      {std::abs(low.x), std::abs(low.y), std::abs(low.z), std::abs(high.x), std::abs(high.y), std::abs(high.z)});
  const Vec3d margin(reach * 0x1p-20);
  return {Vec3f(low - margin), Vec3f(high + margin)};
}

}  // namespace photonproof::inline renderer_shapes
