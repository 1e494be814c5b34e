#include "renderer/sensor/camera.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "renderer/sensor/reconstruction_filter.h"
#include "scenes/base/faults.h"
#include "scenes/description/field_of_view.h"
#include "scenes/description/sensors.h"

namespace photonproof::inline renderer_sensor {
namespace {

/// Sets the members that depend on the kind of camera, for a film of this size.
struct Lens {
  CameraView& view;
  const Transform& to_world;
  double film_width, film_height;

  void operator()(const PerspectiveDescription& camera) const {
    const Vec2<double> tangents = half_tangents(
        camera.fov_degrees, has_fault(Fault::fov_axis) ? FovAxis::y : camera.fov_axis, film_width, film_height);
    set(tangents.x, tangents.y, camera.near_clip, camera.far_clip);
    // As in Mitsuba, the offset is added to a pixel's place.
    view.center_x -= static_cast<float>(2 * camera.principal_x);
    view.center_y -= static_cast<float>(2 * camera.principal_y);
  }
  void operator()(const ThinLensDescription& camera) const {
    (*this)(camera.perspective);
    view.kind = CameraKind::thin_lens;
    view.lens_radius = static_cast<float>(camera.aperture_radius);
    view.focus_distance = static_cast<float>(camera.focus_distance);
  }
  void operator()(const OrthographicDescription& camera) const {
    view.kind = CameraKind::orthographic;
    // Mitsuba scales the near plane by to_world, but not the distance from there to the far plane.
    const double near = camera.near_clip * length(to_world.vector({0, 0, 1}));
    set(length(to_world.vector({1, 0, 0})), length(to_world.vector({0, 1, 0})) * film_height / film_width, near,
        near + camera.far_clip - camera.near_clip);
  }
  void operator()(const FisheyeDescription& camera) const {
    view.kind = CameraKind::fisheye;
    const double angle = camera.fov_degrees * std::numbers::pi / 360, shorter = std::min(film_width, film_height);
    view.max_angle = static_cast<float>(angle);
    set(angle * film_width / shorter, angle * film_height / shorter, camera.near_clip, camera.far_clip);
  }
  /// The parts have their own lenses and near planes.
  void operator()(const BatchDescription&) const {
    view.kind = CameraKind::batch;
    view.far = std::numeric_limits<float>::infinity();
  }
  template <class Meter>
  void operator()(const Meter&) const {}

 private:
  void set(double half_width, double half_height, double near, double far) const {
    view.tan_x = static_cast<float>(half_width);
    view.tan_y = static_cast<float>(half_height);
    view.near = static_cast<float>(near);
    view.far = static_cast<float>(far);
  }
};

CameraView view_of(const SensorDescription& sensor, int width, int height, const Vec3d& moved) {
  CameraView view{.origin = Vec3f(sensor.to_world.point({0, 0, 0}) + moved),
                  .right = Vec3f(normalize(sensor.to_world.vector({-1, 0, 0}))),
                  .up = Vec3f(normalize(sensor.to_world.vector({0, 1, 0}))),
                  .forward = Vec3f(normalize(sensor.to_world.vector({0, 0, 1}))),
                  .inverse_width = 1 / static_cast<float>(width),
                  .inverse_height = 1 / static_cast<float>(height),
                  .width = static_cast<float>(width),
                  .height = static_cast<float>(height),
                  .filter = compile_filter(sensor.film.filter, sensor.film.sample_border)};
  std::visit(Lens{view, sensor.to_world, double(width), double(height)}, sensor.camera);
  return view;
}

}  // namespace

CameraView compile_camera(const SensorDescription& sensor, int width, int height, const MeterPlace& place) {
  CameraView view = view_of(sensor, width, height, place.moved);
  if (is_meter(sensor)) set_meter(view, sensor, place);
  return view;
}

std::vector<CameraView> compile_parts(const SensorDescription& sensor, int width, int height, const Vec3d& moved) {
  const auto* batch = std::get_if<BatchDescription>(&sensor.camera);
  if (batch == nullptr) return {};
  std::vector<CameraView> parts;
  for (const BatchView& part : batch->views) {
    SensorDescription alone = sensor;
    std::visit([&](const auto& camera) { alone.camera = camera; }, part.camera);
    alone.to_world = part.to_world;
    parts.push_back(view_of(alone, width / static_cast<int>(batch->views.size()), height, moved));
  }
  return parts;
}

float pixel_footprint(const CameraView& camera, const Vec3f& p_world) {
  const float at_unit_distance = 2 * camera.tan_y * camera.inverse_height;
  const Vec3f from_camera = p_world - camera.origin;
  switch (camera.kind) {
    case CameraKind::orthographic:
      return at_unit_distance;
    case CameraKind::parallel:
    case CameraKind::irradiance:
      return 2 * length(camera.up);
    case CameraKind::fisheye:
      return at_unit_distance * length(from_camera);
    case CameraKind::batch: {
      float least = std::numeric_limits<float>::infinity();
      for (std::uint32_t i = 0; i < camera.part_count; ++i)
        if (const float f = pixel_footprint(camera.parts[i], p_world); f > 0) least = std::min(least, f);
      return std::isfinite(least) ? least : 0;
    }
    default:
      return at_unit_distance * dot(from_camera, camera.forward);
  }
}

}  // namespace photonproof::inline renderer_sensor
