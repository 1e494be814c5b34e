#include "renderer/looked_at.h"

#include <algorithm>

#include "renderer/kernels/camera_rays.h"

namespace photonproof {

std::vector<Vec3f> points_looked_at(const Scene& scene, int lattice) {
  const CameraView& camera = scene.view().camera;
  const auto share = [lattice](int i) { return (static_cast<float>(i) + 0.5f) / static_cast<float>(lattice); };
  std::vector<Vec3f> points;
  for (int row = 0; row < lattice; ++row) {
    for (int column = 0; column < lattice; ++column) {
      CameraRay<float> ray;
      set_ray<float>(camera, {share(column) * camera.width, share(row) * camera.height}, {0.5f, 0.5f}, ray);
      const Hit hit = ray.valid ? scene.intersect(ray.origin, ray.direction) : Hit{};
      if (hit.valid()) points.push_back(hit.p_world);
    }
  }
  return points;
}

std::vector<AimTarget> looked_at(const Scene& scene) {
  constexpr int lattice = 4;
  const CameraView& camera = scene.view().camera;
  const float cell = std::max(camera.width, camera.height) / lattice;
  std::vector<AimTarget> balls;
  for (const Vec3f& p : points_looked_at(scene, lattice))
    balls.push_back({p, 0.75f * cell * pixel_footprint(camera, p)});  // half the diagonal of a cell
  return balls;
}

}  // namespace photonproof
