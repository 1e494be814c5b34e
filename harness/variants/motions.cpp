#include "harness/variants/motions.h"

#include <string>
#include <variant>

#include "scenes/description/overloaded.h"

namespace photonproof {
namespace {

void move_lamp(EmitterDescription& emitter, const Transform& motion) {
  std::visit(
      Overloaded{[&](PointLightDescription& light) { light.position = motion.point(light.position); },
                 [&](DirectionalLightDescription& light) { light.direction = motion.vector(light.direction); },
                 [](ConstantLightDescription&) {}, [&](auto& light) { light.to_world = motion * light.to_world; }},
      emitter.light);
}

/// A mirror image of itself in local space, where the shape has one; by it the whole transform keeps its handedness.
bool mirror_of_itself(const ShapeDescription& shape, Transform& local) {
  const Transform flip = Transform::scale({-1, 1, 1});
  return std::visit(
      Overloaded{[&](const SphereDescription& sphere) {
                   local = Transform::translate(sphere.center) * flip * Transform::translate(-sphere.center);
                   return true;
                 },
                 [&](const RectangleDescription&) { return local = flip, true; },
                 [&](const DiskDescription&) { return local = flip, true; },
                 [&](const CubeDescription&) { return local = flip, true; }, [](const auto&) { return false; }},
      shape.geometry);
}

bool is_of_triangles(const ShapeDescription& shape) {
  return std::holds_alternative<MeshDescription>(shape.geometry) ||
         std::holds_alternative<HeightfieldDescription>(shape.geometry);
}

}  // namespace

void move_everything(SceneDescription& scene, const Transform& motion) {
  for (ShapeDescription& shape : scene.shapes) shape.to_world = motion * shape.to_world;
  for (EmitterDescription& emitter : scene.emitters) move_lamp(emitter, motion);
  scene.sensor.to_world = motion * scene.sensor.to_world;
}

void mirror_in_view(SceneDescription& scene) {
  const Transform camera = scene.sensor.to_world;
  const std::optional<Transform> back = camera.inverse();
  if (!back) throw InputError(scene.where(scene.sensor.loc), "the camera's to_world has no inverse");
  const Transform mirror = camera * Transform::scale({-1, 1, 1}) * *back;
  const bool textured = !scene.textures.empty();  // an image on the shape must be mirrored, too
  for (ShapeDescription& shape : scene.shapes) {
    Transform local;
    const bool itself = !textured && mirror_of_itself(shape, local);
    shape.to_world = mirror * shape.to_world * local;
    if (!itself && is_of_triangles(shape)) shape.flip_normals = !shape.flip_normals;  // as its corners' order turns
  }
  for (EmitterDescription& emitter : scene.emitters) {
    const bool even = std::holds_alternative<PointLightDescription>(emitter.light) ||
                      std::holds_alternative<DirectionalLightDescription>(emitter.light) ||
                      std::holds_alternative<ConstantLightDescription>(emitter.light);
    if (!even) throw InputError(scene.where(emitter.loc), "a lamp of this kind cannot be mirrored");
    move_lamp(emitter, mirror);
  }
}

}  // namespace photonproof
