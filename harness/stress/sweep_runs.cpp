#include "harness/stress/sweep_runs.h"

#include <variant>

#include "harness/variants/motions.h"
#include "scenes/description/overloaded.h"
#include "scenes/description/scene_volumes.h"

namespace photonproof::inline harness_stress {
namespace {

void scale_light(EmitterDescription& emitter, const Transform& scale, double by) {
  std::visit(Overloaded{[&](PointLightDescription& light) {
                          light.position = light.position * by;
                          light.intensity = light.intensity * (by * by);
                        },
                        [&](SpotLightDescription& light) {
                          light.to_world = scale * light.to_world;
                          light.intensity = light.intensity * (by * by);
                        },
                        [&](IesLightDescription& light) {
                          light.to_world = scale * light.to_world;
                          light.intensity = light.intensity * (by * by);
                        },
                        [&](ProjectorDescription& light) {
                          light.to_world = scale * light.to_world;
                          light.scale *= by;
                        },
                        [](auto&) {}},
             emitter.light);
}

void scale_camera(SensorDescription& sensor, const Transform& scale, double by) {
  const auto clips = [&](auto& camera) {
    camera.near_clip *= by;
    camera.far_clip *= by;
  };
  // The orthographic camera's view scales with its to_world, which also places its near plane. Its far plane is a
  // length in world units. The other cameras only turn and move.
  if (auto* camera = std::get_if<OrthographicDescription>(&sensor.camera)) {
    sensor.to_world = scale * sensor.to_world;
    camera->far_clip = camera->near_clip + (camera->far_clip - camera->near_clip) * by;
    return;
  }
  for (const std::size_t i : {3, 7, 11}) sensor.to_world.m[i] *= by;
  std::visit(Overloaded{[&](ThinLensDescription& camera) {
                          clips(camera.perspective);
                          camera.aperture_radius *= by;
                          camera.focus_distance *= by;
                        },
                        [](RadianceMeterDescription&) {}, [](IrradianceMeterDescription&) {}, [](BatchDescription&) {},
                        [](DistantDescription&) {}, [&](auto& camera) { clips(camera); }},
             sensor.camera);
}

void scale_bsdf(BsdfDescription& bsdf, double by) {
  if (auto* bumps = std::get_if<BumpMapDescription>(&bsdf.model)) bumps->scale *= by;
  if (auto* lacquer = std::get_if<LayeredDescription>(&bsdf.model)) {
    lacquer->thickness *= by;
    lacquer->sigma_a = lacquer->sigma_a * (1 / by);
  }
}

}  // namespace

SceneDescription in_another_unit(SceneDescription scene, double by) {
  const Transform scale = Transform::scale(Vec3d(by));
  for (ShapeDescription& shape : scene.shapes) shape.to_world = scale * shape.to_world;
  for (EmitterDescription& emitter : scene.emitters) scale_light(emitter, scale, by);
  for (BsdfDescription& bsdf : scene.bsdfs) scale_bsdf(bsdf, by);
  for (MediumDescription& medium : scene.media) std::visit([&](auto& model) { model.scale /= by; }, medium.model);
  visit_volumes(scene, [&](auto& volume) { volume.to_world = scale * volume.to_world; });
  scale_camera(scene.sensor, scale, by);
  if (auto* photons = std::get_if<PhotonMapperDescription>(&scene.integrator.method)) {
    photons->global_radius *= by;
    photons->caustic_radius *= by;
  }
  return scene;
}

SceneDescription moved(SceneDescription scene, const Vec3d& by) {
  move_everything(scene, Transform::translate(by));
  return scene;
}

SceneDescription turned(SceneDescription scene) {
  move_everything(scene, Transform::rotate({1, 2, 3}, 40));
  return scene;
}

SceneDescription brighter(SceneDescription scene, double by) {
  for (ShapeDescription& shape : scene.shapes)
    if (shape.radiance)
      if (auto* radiance = std::get_if<RgbD>(&*shape.radiance)) *radiance = *radiance * by;
  for (EmitterDescription& emitter : scene.emitters)
    std::visit(Overloaded{[&](PointLightDescription& light) { light.intensity = light.intensity * by; },
                          [&](SpotLightDescription& light) { light.intensity = light.intensity * by; },
                          [&](IesLightDescription& light) { light.intensity = light.intensity * by; },
                          [&](DirectionalLightDescription& light) { light.irradiance = light.irradiance * by; },
                          [&](ConstantLightDescription& light) { light.radiance = light.radiance * by; },
                          [&](EnvmapDescription& light) { light.scale *= by; },
                          [&](ProjectorDescription& light) { light.scale *= by; },
                          [&](SunSkyDescription& light) {
                            light.sun_scale *= by;
                            light.sky_scale *= by;
                          }},
               emitter.light);
  return scene;
}

}  // namespace photonproof::inline harness_stress
