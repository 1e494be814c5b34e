#include "renderer/scene/find_clear_ways.h"

#include "renderer/scene/projection_targets.h"

namespace photonproof::inline renderer_scene {

ClearWays find_clear_ways(const SceneParts& scene) {
  ClearWays ways;
  const std::vector<Surface>& surfaces = scene.surfaces;
  const std::size_t count = surfaces.size();
  for (const Surface& surface : surfaces)
    if (const auto* plane = std::get_if<Plane>(&surface.geometry))
      ways.walls.push_back({Vec3f(plane->point), Vec3f(plane->normal)});

  // Boxes around the first k surfaces, and around those from number k on.
  std::vector<ShapeBox> before(count + 1), from = scene.boxes;
  from.emplace_back();
  for (std::size_t i = 0; i < count; ++i) {
    before[i + 1] = before[i];
    before[i + 1].add(scene.boxes[i]);
  }
  for (std::size_t i = count; i-- > 0;) from[i].add(from[i + 1]);

  ways.others.assign(scene.lights.size(), ball_around_box(from[0]));
  const auto leave_out = [&](std::size_t first, std::size_t last) {
    ShapeBox rest = before[first];
    rest.add(from[last]);
    for (std::size_t i = first; i < last; ++i)
      if (surfaces[i].light != no_index) ways.others[surfaces[i].light] = ball_around_box(rest);
  };
  for (std::size_t i = 0; i < count; ++i)
    if (surfaces[i].light != no_index && mesh_of(surfaces[i].geometry) == nullptr) leave_out(i, i + 1);
  for (const std::size_t cube : scene.cubes) leave_out(cube, cube + 6);
  return ways;
}

}  // namespace photonproof::inline renderer_scene
