#include "renderer/scene/scaled_description.h"

namespace photonproof::inline renderer_scene {
namespace {

struct CameraScaler {
  double factor;

  void operator()(ThinLensDescription& camera) const {
    clip(camera.perspective);
    camera.aperture_radius *= factor;
    camera.focus_distance *= factor;
  }
  /// Scales only the distance between the planes: to_world scales the near plane and the width.
  void operator()(OrthographicDescription& camera) const {
    camera.far_clip = camera.near_clip + (camera.far_clip - camera.near_clip) * factor;
  }
  void operator()(RadianceMeterDescription&) const {}
  void operator()(IrradianceMeterDescription&) const {}
  void operator()(DistantDescription& camera) const {
    if (auto* point = std::get_if<Vec3d>(&camera.target)) *point = *point * factor;
    if (auto* area = std::get_if<TargetArea>(&camera.target))
      area->to_world = Transform::scale(Vec3d(factor)) * area->to_world;
  }
  void operator()(BatchDescription& batch) const {
    for (BatchView& view : batch.views) {
      view.to_world = Transform::scale(Vec3d(factor)) * view.to_world;
      std::visit(*this, view.camera);
    }
  }
  template <class Camera>
  void operator()(Camera& camera) const {
    clip(camera);
  }

 private:
  template <class Camera>
  void clip(Camera& camera) const {
    camera.near_clip *= factor;
    camera.far_clip *= factor;
  }
};

}  // namespace

SceneDescription scaled(SceneDescription description, double factor) {
  const Transform scale = Transform::scale(Vec3d(factor));
  for (ShapeDescription& shape : description.shapes) {
    shape.to_world = scale * shape.to_world;
    if (auto* curves = std::get_if<CurvesDescription>(&shape.geometry)) curves->radius_scale *= factor;
  }
  for (EmitterDescription& emitter : description.emitters)
    std::visit([&](auto& light) { light.scale_lengths(factor); }, emitter.light);
  for (MediumDescription& medium : description.media)
    std::visit([&](auto& model) { model.scale /= factor; }, medium.model);
  for (BsdfDescription& bsdf : description.bsdfs)
    if (auto* bumps = std::get_if<BumpMapDescription>(&bsdf.model)) bumps->scale *= factor;
  SensorDescription& sensor = description.sensor;
  sensor.to_world = scale * sensor.to_world;
  std::visit(CameraScaler{factor}, sensor.camera);
  return description;
}

}  // namespace photonproof::inline renderer_scene
