#include "renderer/aim_targets.h"

#include <algorithm>
#include <limits>

namespace photonproof {
namespace {

AimTarget ball_around(const Sphere& sphere) { return {sphere.center, sphere.radius}; }

AimTarget ball_around(const Quad& quad) {
  const Vec3f half_diagonal = (quad.edge_u + quad.edge_v) * 0.5f;
  const float reach = std::max(length(half_diagonal), length((quad.edge_u - quad.edge_v) * 0.5f));
  return {quad.corner + half_diagonal, reach};
}

AimTarget ball_around(const Mesh& mesh) {
  Vec3f low(std::numeric_limits<float>::infinity()), high = -low;
  for (std::size_t i = 0; i + 1 < mesh.positions.size(); ++i) {  // the last is a spare
    const Vec3f& p = mesh.positions[i];
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  return {(low + high) * 0.5f, length(high - low) * 0.5f};
}

}  // namespace

std::vector<AimTarget> aim_targets(const std::vector<Surface>& surfaces, const std::vector<Bsdf>& bsdfs) {
  constexpr float margin = 1 + 1e-4f;  // what rounding could leave outside
  std::vector<AimTarget> targets;
  for (const Surface& surface : surfaces) {
    if (is_lambertian(bsdfs[surface.bsdf])) continue;
    AimTarget target = std::visit([](const auto& g) { return ball_around(g); }, surface.geometry);
    target.radius *= margin;
    targets.push_back(target);
  }
  return targets;
}

}  // namespace photonproof
