#include "reference/engines/lowered_camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <variant>

#include "reference/engines/not_representable.h"

namespace photonproof::inline reference_engines {
namespace {

/// Tangent of half the field of view per pixel along its axis.
double tangent_per_pixel(const PerspectiveDescription& perspective, int width, int height) {
  const double tangent = std::tan(perspective.fov_degrees * std::numbers::pi / 360);
  switch (perspective.fov_axis) {
    case FovAxis::x:
      return tangent / width;
    case FovAxis::y:
      return tangent / height;
    case FovAxis::diagonal:
      return tangent / std::hypot(width, height);
    case FovAxis::smaller:
      return tangent / std::min(width, height);
    case FovAxis::larger:
      return tangent / std::max(width, height);
  }
  return tangent / width;
}

struct Lens {
  const SceneDescription& scene;
  LoweredCamera& camera;
  int width, height, margin;
  const std::string& engine;

  void operator()(const PerspectiveDescription& perspective) const {
    const double per_pixel = tangent_per_pixel(perspective, width, height);
    camera.tan_x = per_pixel * (width + 2 * margin);
    camera.tan_y = per_pixel * (height + 2 * margin);
    // As in Mitsuba, the offset is added to a pixel's place.
    camera.middle_x = 2 * perspective.principal_x * width / (width + 2 * margin);
    camera.middle_y = -2 * perspective.principal_y * height / (height + 2 * margin);
    clip(perspective.near_clip, perspective.far_clip);
  }
  void operator()(const ThinLensDescription& lens) const {
    (*this)(lens.perspective);
    if (!(lens.aperture_radius > 0)) return;
    camera.kind = LoweredCamera::Kind::thin_lens;
    camera.lens_radius = lens.aperture_radius;
    camera.focus_distance = lens.focus_distance;
  }
  void operator()(const OrthographicDescription& parallel) const {
    camera.kind = LoweredCamera::Kind::orthographic;
    const Transform& t = scene.sensor.to_world;
    camera.tan_x = length(t.vector({1, 0, 0})) * (width + 2 * margin) / width;
    camera.tan_y = length(t.vector({0, 1, 0})) * (height + 2 * margin) / width;
    const double near = parallel.near_clip * length(t.vector({0, 0, 1}));
    clip(near, near + parallel.far_clip - parallel.near_clip);
  }
  void operator()(const FisheyeDescription& fisheye) const {
    camera.kind = LoweredCamera::Kind::fisheye;
    camera.angle = fisheye.fov_degrees * std::numbers::pi / 180;
    if (width != height || margin > 0)
      throw NotRepresentable(engine, scene.where(scene.sensor.loc),
                             "a fisheye camera's picture that is not square, or has another filter than box");
    clip(fisheye.near_clip, fisheye.far_clip);
  }
  template <class Meter>
  void operator()(const Meter&) const {
    throw NotRepresentable(engine, scene.where(scene.sensor.loc), "a sensor that is no single camera");
  }

 private:
  void clip(double near, double far) const {
    camera.near_clip = near;
    camera.far_clip = far;
  }
};

}  // namespace

LoweredCamera lower_camera(const SceneDescription& scene, int width, int height, int margin,
                           const std::string& engine) {
  const SensorDescription& sensor = scene.sensor;
  LoweredCamera camera;
  camera.origin = sensor.to_world.point({0, 0, 0});
  camera.forward = normalize(sensor.to_world.vector({0, 0, 1}));
  camera.right = normalize(sensor.to_world.vector({-1, 0, 0}));
  camera.up = normalize(sensor.to_world.vector({0, 1, 0}));
  const double skew = std::max({std::abs(dot(camera.forward, camera.right)), std::abs(dot(camera.forward, camera.up)),
                                std::abs(dot(camera.right, camera.up))});
  if (!(skew < 1e-9))
    throw NotRepresentable(engine, scene.where(sensor.loc), "a camera whose axes are not perpendicular");
  std::visit(Lens{scene, camera, width, height, margin, engine}, sensor.camera);
  return camera;
}

}  // namespace photonproof::inline reference_engines
