#include "renderer/sensor/meters.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "scenes/description/overloaded.h"

namespace photonproof::inline renderer_sensor {
namespace {

/// A part of a plane: the square or disc of these half axes around a point.
struct Patch {
  Vec3d middle, half_u, half_v;
  bool is_disk = false;
};

Patch patch_of(const Transform& to_world, bool is_disk) {
  return {to_world.point({0, 0, 0}), to_world.vector({1, 0, 0}), to_world.vector({0, 1, 0}), is_disk};
}

/// Rays start all over the patch, whose place follows from the film's.
void start_from(CameraView& view, const Patch& patch, const Vec3d& moved) {
  view.origin = Vec3f(patch.middle + moved);
  view.right = Vec3f(patch.half_u);
  view.up = Vec3f(patch.half_v);
  view.tan_x = view.tan_y = 1;
  view.is_round = patch.is_disk;
}

void start_from_point(CameraView& view, const Vec3d& origin) {
  view.kind = CameraKind::perspective;
  view.origin = Vec3f(origin);
  view.tan_x = view.tan_y = 0;
}

void set_distant(CameraView& view, const DistantDescription& d, const MeterPlace& place) {
  const Vec3d forward(view.forward);
  // As in Mitsuba, two radii before what is aimed at.
  const Vec3d back = forward * (-2 * place.radius);
  if (const auto* target = std::get_if<Vec3d>(&d.target)) return start_from_point(view, *target + place.moved + back);
  view.kind = CameraKind::parallel;
  if (const auto* area = std::get_if<TargetArea>(&d.target)) {
    const Patch patch = patch_of(area->to_world, area->is_disk);
    return start_from(view, {patch.middle + back, patch.half_u, patch.half_v, patch.is_disk}, place.moved);
  }
  const Vec3d right = Vec3d(view.right) * place.radius, up = Vec3d(view.up) * place.radius;
  start_from(view, {place.centre - forward * place.radius, right, up, true}, {0, 0, 0});
}

void set_irradiance(CameraView& view, const MeterPlace& place) {
  view.kind = CameraKind::irradiance;
  view.image_factor = std::numbers::pi;  // the mean radiance of directions by their cosine becomes the irradiance
  const ShapeDescription& shape = *place.surface;
  Patch patch = patch_of(shape.to_world, std::holds_alternative<DiskDescription>(shape.geometry));
  const bool is_turned = shape.flip_normals != (shape.to_world.determinant() < 0);
  const Vec3d normal = normalize(cross(patch.half_u, patch.half_v)) * (is_turned ? -1.0 : 1.0);
  const Vec3d middle = patch.middle + place.moved;
  double largest = place.coordinate_floor;
  for (const Vec3d& axis : {Vec3d{1, 0, 0}, {0, 1, 0}, {0, 0, 1}})
    largest = std::max(
        largest, std::abs(dot(middle, axis)) + std::abs(dot(patch.half_u, axis)) + std::abs(dot(patch.half_v, axis)));
  patch.middle += normal * (4 * 0x1p-23 * largest);
  view.forward = Vec3f(normal);
  start_from(view, patch, place.moved);
}

}  // namespace

const ShapeDescription* measuring_shape(const SceneDescription& description) {
  const auto found = std::ranges::find_if(description.shapes, &ShapeDescription::measures);
  return found != description.shapes.end() ? &*found : nullptr;
}

void set_meter(CameraView& view, const SensorDescription& sensor, const MeterPlace& place) {
  view.near = 0;
  view.far = std::numeric_limits<float>::infinity();
  if (std::holds_alternative<RadianceMeterDescription>(sensor.camera))
    start_from_point(view, sensor.to_world.point({0, 0, 0}) + place.moved);
  else if (const auto* distant = std::get_if<DistantDescription>(&sensor.camera))
    set_distant(view, *distant, place);
  else
    set_irradiance(view, place);
}

}  // namespace photonproof::inline renderer_sensor
