#include "renderer/scene/looked_at.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "renderer/rays/surface_hit.h"
#include "renderer/sensor/camera_ray.h"

namespace photonproof::inline renderer_scene {

namespace {

/// First hit behind lights that are hidden from the camera.
Hit first_seen(const Scene& scene, Vec3f origin, const Vec3f& direction) {
  constexpr int most_lights = 16;
  const auto is_hidden = [&](const Hit& hit) {
    return scene.view().hides_lights && hit.valid() && scene.surfaces[hit.surface].light != no_index;
  };
  Hit hit = scene.intersect(origin, direction);
  for (int i = 0; i < most_lights && is_hidden(hit); ++i) {
    origin = offset_from(hit.p_world, hit.normal, direction, scene.view().coordinate_floor);
    hit = scene.intersect(origin, direction);
  }
  return hit;
}

/// Points row by row; NaN where the ray meets nothing.
std::vector<Vec3f> lattice_of_hits(const Scene& scene, int lattice) {
  const CameraView& camera = scene.view().camera;
  const auto share = [lattice](int i) { return (static_cast<float>(i) + 0.5f) / static_cast<float>(lattice); };
  std::vector<Vec3f> points;
  for (int row = 0; row < lattice; ++row) {
    for (int column = 0; column < lattice; ++column) {
      CameraRay<float> ray;
      set_ray<float>(camera, {share(column) * camera.width, share(row) * camera.height}, {0.5f, 0.5f}, ray);
      const Hit hit = ray.valid ? first_seen(scene, ray.origin, ray.direction) : Hit{};
      points.push_back(hit.valid() ? hit.p_world : Vec3f(std::numeric_limits<float>::quiet_NaN()));
    }
  }
  return points;
}

}  // namespace

std::vector<Vec3f> points_looked_at(const Scene& scene, int lattice) {
  std::vector<Vec3f> points = lattice_of_hits(scene, lattice);
  points.erase(std::remove_if(points.begin(), points.end(), [](const Vec3f& p) { return !is_finite(p); }),
               points.end());
  return points;
}

std::vector<ProjectionTarget> looked_at(const Scene& scene) {
  constexpr int lattice = 4;
  constexpr float half_diagonal = 0.75f;  // of a cell
  const CameraView& camera = scene.view().camera;
  const float cell = std::max(camera.width, camera.height) / lattice;
  const std::vector<Vec3f> points = lattice_of_hits(scene, lattice);
  const auto at = [&](int row, int column) { return points[static_cast<std::size_t>(row * lattice + column)]; };
  // To the nearer of the two neighbours along an axis, since behind an edge the other is far away.
  const auto spacing = [&](int row, int column, int down, int right) {
    float nearest = std::numeric_limits<float>::infinity();
    for (const int sign : {-1, 1}) {
      const int r = row + sign * down, c = column + sign * right;
      if (r < 0 || r >= lattice || c < 0 || c >= lattice) continue;
      const float d = length(at(r, c) - at(row, column));
      if (d < nearest) nearest = d;
    }
    return std::isfinite(nearest) ? nearest : 0;
  };
  std::vector<ProjectionTarget> balls;
  for (int row = 0; row < lattice; ++row)
    for (int column = 0; column < lattice; ++column) {
      const Vec3f p = at(row, column);
      if (!is_finite(p)) continue;
      // Surfaces seen at a slant are longer than the cell is wide.
      const float size =
          std::max({cell * pixel_footprint(camera, p), spacing(row, column, 1, 0), spacing(row, column, 0, 1)});
      balls.push_back({p, half_diagonal * size});
    }
  return balls;
}

}  // namespace photonproof::inline renderer_scene
