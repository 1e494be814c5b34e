#include "reference/engines/far_square.h"

#include <algorithm>
#include <utility>

namespace photonproof::inline reference_engines {

std::shared_ptr<TriangleMesh> far_square(const Transform& to_world, const Bounds3d& scene) {
  const auto inverse = to_world.inverse();
  if (!inverse) return nullptr;
  const Vec3d middle = inverse->point((scene.low + scene.high) * 0.5);
  const double unit = std::min(length(to_world.vector({1, 0, 0})), length(to_world.vector({0, 1, 0})));
  const double half = 1000 * length(scene.high - scene.low) / unit;
  auto mesh = std::make_shared<TriangleMesh>();
  for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
    const Vec3f p(Vec3d{middle.x + x * half, middle.y + y * half, 0});
    mesh->positions.push_back(p);
    mesh->uvs.push_back({p.x, p.y});
  }
  mesh->triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

}  // namespace photonproof::inline reference_engines
