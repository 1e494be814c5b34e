#include "renderer/camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace photonproof {
namespace {

/// Half-angle tangents along x and y for a full angle given along `axis`.
Vec2<double> half_tangents(const PerspectiveDescription& camera, double width, double height) {
  const double tangent = std::tan(camera.fov_degrees * std::numbers::pi / 360);
  FovAxis axis = camera.fov_axis;
  if (axis == FovAxis::smaller) axis = width < height ? FovAxis::x : FovAxis::y;
  if (axis == FovAxis::larger) axis = width < height ? FovAxis::y : FovAxis::x;
  switch (axis) {
    case FovAxis::y:
      return {tangent * width / height, tangent};
    case FovAxis::diagonal: {
      const double diagonal = std::hypot(width, height);
      return {tangent * width / diagonal, tangent * height / diagonal};
    }
    default:
      return {tangent, tangent * height / width};
  }
}

}  // namespace

CameraView compile_camera(const SensorDescription& sensor, int width, int height, const Vec3d& moved) {
  const auto& perspective = std::get<PerspectiveDescription>(sensor.camera);
  const Vec2<double> tangents = half_tangents(perspective, width, height);
  return {.origin = Vec3f(sensor.to_world.point({0, 0, 0}) + moved),
          .right = Vec3f(normalize(sensor.to_world.vector({-1, 0, 0}))),
          .up = Vec3f(normalize(sensor.to_world.vector({0, 1, 0}))),
          .forward = Vec3f(normalize(sensor.to_world.vector({0, 0, 1}))),
          .tan_x = static_cast<float>(tangents.x),
          .tan_y = static_cast<float>(tangents.y),
          .inverse_width = 1 / static_cast<float>(width),
          .inverse_height = 1 / static_cast<float>(height),
          .near = static_cast<float>(perspective.near_clip),
          .far = static_cast<float>(perspective.far_clip)};
}

float pixel_footprint(const CameraView& camera, const Vec3f& p_world) {
  return 2 * camera.tan_y * camera.inverse_height * dot(p_world - camera.origin, camera.forward);
}

}  // namespace photonproof
