#include "harness/variants/motions.h"

#include <string>
#include <variant>

#include "scenes/description/overloaded.h"
#include "scenes/description/scene_volumes.h"

namespace photonproof::inline harness_variants {
namespace {

void move_light(EmitterDescription& emitter, const Transform& motion) {
  std::visit(
      Overloaded{[&](PointLightDescription& light) { light.position = motion.point(light.position); },
                 [&](DirectionalLightDescription& light) { light.direction = motion.vector(light.direction); },
                 [](ConstantLightDescription&) {}, [&](auto& light) { light.to_world = motion * light.to_world; }},
      emitter.light);
}

void move_sensor(SensorDescription& sensor, const Transform& motion) {
  sensor.to_world = motion * sensor.to_world;
  if (auto* batch = std::get_if<BatchDescription>(&sensor.camera))
    for (BatchView& view : batch->views) view.to_world = motion * view.to_world;
  auto* distant = std::get_if<DistantDescription>(&sensor.camera);
  if (distant == nullptr) return;
  if (auto* point = std::get_if<Vec3d>(&distant->target)) *point = motion.point(*point);
  if (auto* area = std::get_if<TargetArea>(&distant->target)) area->to_world = motion * area->to_world;
}

/// Mirrors a symmetric shape in its local space, so that the whole transform keeps its handedness; leaves other shapes.
Transform mirror_of_itself(const ShapeDescription& shape) {
  const Transform flip = Transform::scale({-1, 1, 1});
  return std::visit(
      Overloaded{[&](const SphereDescription& sphere) {
                   return Transform::translate(sphere.center) * flip * Transform::translate(-sphere.center);
                 },
                 [&](const RectangleDescription&) { return flip; }, [&](const DiskDescription&) { return flip; },
                 [&](const CubeDescription&) { return flip; }, [](const auto&) { return Transform(); }},
      shape.geometry);
}

}  // namespace

void move_everything(SceneDescription& scene, const Transform& motion) {
  for (ShapeDescription& shape : scene.shapes) shape.to_world = motion * shape.to_world;
  for (EmitterDescription& emitter : scene.emitters) move_light(emitter, motion);
  visit_volumes(scene, [&](auto& volume) { volume.to_world = motion * volume.to_world; });
  move_sensor(scene.sensor, motion);
}

void mirror_in_view(SceneDescription& scene) {
  const Transform camera = scene.sensor.to_world;
  const std::optional<Transform> back = camera.inverse();
  if (!back) throw InputError(scene.where(scene.sensor.loc), "the camera's to_world has no inverse");
  const Transform mirror = camera * Transform::scale({-1, 1, 1}) * *back;
  const bool textured = !scene.textures.empty();  // an image on the shape must be mirrored too
  for (ShapeDescription& shape : scene.shapes) {
    shape.to_world = mirror * shape.to_world;
    if (!textured) shape.to_world = shape.to_world * mirror_of_itself(shape);
  }
  for (EmitterDescription& emitter : scene.emitters) {
    const bool even = std::holds_alternative<PointLightDescription>(emitter.light) ||
                      std::holds_alternative<DirectionalLightDescription>(emitter.light) ||
                      std::holds_alternative<ConstantLightDescription>(emitter.light);
    if (!even) throw InputError(scene.where(emitter.loc), "a light of this kind cannot be mirrored");
    move_light(emitter, mirror);
  }
  visit_volumes(scene, [&](auto& volume) { volume.to_world = mirror * volume.to_world; });
}

}  // namespace photonproof::inline harness_variants
