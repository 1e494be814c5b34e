#include "renderer/shapes/extent.h"

#include <algorithm>

namespace photonproof::inline renderer_shapes {

void Extent::add(const Vec3d& p) {
  low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
  high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
}

void Extent::add(const Extent& other) {
  add(other.low);
  add(other.high);
}

void Extent::add_box(const Transform& to_world, const Vec3d& local_low, const Vec3d& local_high) {
  for (int corner = 0; corner < 8; ++corner) {
    const auto pick = [&](int bit, double a, double b) { return (corner >> bit & 1) != 0 ? b : a; };
    add(to_world.point(
        {pick(0, local_low.x, local_high.x), pick(1, local_low.y, local_high.y), pick(2, local_low.z, local_high.z)}));
  }
}

void Extent::add_ball(const Transform& to_world, const Vec3d& center, double radius) {
  const Vec3d middle = to_world.point(center);
  const Vec3d reach(radius * to_world.similarity_scale());
  add(middle - reach);
  add(middle + reach);
}

}  // namespace photonproof::inline renderer_shapes
