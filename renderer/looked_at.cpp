#include "renderer/looked_at.h"

#include <algorithm>

#include "renderer/kernels/camera_rays.h"

namespace photonproof {

std::vector<AimTarget> looked_at(const Scene& scene) {
  constexpr int lattice = 4;
  const CameraView& camera = scene.view().camera;
  std::vector<AimTarget> balls;
  for (int row = 0; row < lattice; ++row) {
    for (int column = 0; column < lattice; ++column) {
      const auto share = [](int i) { return (static_cast<float>(i) + 0.5f) / lattice; };
      CameraRay<float> ray;
      set_ray<float>(camera, {share(column) * camera.width, share(row) * camera.height}, {0.5f, 0.5f}, ray);
      const Hit hit = ray.valid ? scene.intersect(ray.origin, ray.direction) : Hit{};
      if (!hit.valid()) continue;
      // Half the diagonal of a cell.
      const float cell = std::max(camera.width, camera.height) / lattice;
      balls.push_back({hit.p_world, 0.75f * cell * pixel_footprint(camera, hit.p_world)});
    }
  }
  return balls;
}

}  // namespace photonproof
