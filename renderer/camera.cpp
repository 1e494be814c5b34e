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

Camera::Camera(const SensorDescription& sensor, int width, int height)
    : width_(static_cast<float>(width)), height_(static_cast<float>(height)) {
  const auto& camera = std::get<PerspectiveDescription>(sensor.camera);
  const Vec2<double> tangents = half_tangents(camera, width, height);
  tan_x_ = static_cast<float>(tangents.x);
  tan_y_ = static_cast<float>(tangents.y);
  origin_ = Vec3f(sensor.to_world.point({0, 0, 0}));
  right_ = Vec3f(normalize(sensor.to_world.vector({-1, 0, 0})));
  up_ = Vec3f(normalize(sensor.to_world.vector({0, 1, 0})));
  forward_ = Vec3f(normalize(sensor.to_world.vector({0, 0, 1})));
  near_ = static_cast<float>(camera.near_clip);
  far_ = static_cast<float>(camera.far_clip);
}

Ray Camera::ray(float x, float y) const {
  const float right = (2 * x / width_ - 1) * tan_x_;
  const float up = (1 - 2 * y / height_) * tan_y_;
  const Vec3f through = forward_ + right_ * right + up_ * up;  // reaches the plane one unit ahead
  const float stretch = length(through);
  return {origin_ + through * near_, through / stretch, 0, (far_ - near_) * stretch};
}

}  // namespace photonproof
