#include "harness/variants/split_light.h"

#include <cstddef>
#include <variant>
#include <vector>

namespace photonproof::inline harness_variants {
namespace {

bool is_plain_light(const ShapeDescription& shape) {
  return shape.radiance && std::holds_alternative<RgbD>(*shape.radiance) &&
         std::holds_alternative<RectangleDescription>(shape.geometry) && !shape.measures;
}

/// [low, high] of the local x or y, which spans [-1, 1].
ShapeDescription part_of(ShapeDescription shape, double low, double high, bool along_y) {
  const double half = (high - low) / 2, middle = (high + low) / 2;
  const Vec3d by = along_y ? Vec3d(1, half, 1) : Vec3d(half, 1, 1);
  const Vec3d to = along_y ? Vec3d(0, middle, 0) : Vec3d(middle, 0, 0);
  shape.to_world = shape.to_world * Transform::translate(to) * Transform::scale(by);
  return shape;
}

}  // namespace

void split_a_light(SceneDescription& scene, int which, double share, bool along_y) {
  std::vector<std::size_t> rectangles, points;
  for (std::size_t i = 0; i < scene.shapes.size(); ++i)
    if (is_plain_light(scene.shapes[i])) rectangles.push_back(i);
  for (std::size_t i = 0; i < scene.emitters.size(); ++i)
    if (std::holds_alternative<PointLightDescription>(scene.emitters[i].light)) points.push_back(i);
  const std::size_t lights = rectangles.size() + points.size();
  if (lights == 0) throw InputError("superposition", "the scene has no rectangle or point that shines evenly");
  const std::size_t chosen = static_cast<std::size_t>(which) % lights;
  if (chosen < rectangles.size()) {
    const std::size_t place = rectangles[chosen];
    const ShapeDescription whole = scene.shapes[place];
    const double cut = 2 * share - 1;
    scene.shapes[place] = part_of(whole, -1, cut, along_y);
    ShapeDescription rest = part_of(whole, cut, 1, along_y);
    if (!rest.id.empty()) rest.id += "-2";
    scene.shapes.push_back(rest);
    return;
  }
  EmitterDescription& area_light = scene.emitters[points[chosen - rectangles.size()]];
  EmitterDescription rest = area_light;
  std::get<PointLightDescription>(area_light.light).intensity *= share;
  std::get<PointLightDescription>(rest.light).intensity *= 1 - share;
  if (!rest.id.empty()) rest.id += "-2";
  scene.emitters.push_back(rest);
}

}  // namespace photonproof::inline harness_variants
