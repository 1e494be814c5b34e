#include "renderer/world_camera.h"

namespace photonproof {
namespace {

/// Places are uniform on the image plane, whose size one unit ahead is 4 tan_x tan_y: per solid angle that is
/// 1 / (size cos^3), and across a point at distance r 1 / (size cos^3 r^2) = r / (size depth^3).
float pinhole_density(const CameraView& camera, const Vec3f& from_pinhole) {
  const float depth = dot(from_pinhole, camera.forward);
  return length(from_pinhole) / (4 * camera.tan_x * camera.tan_y * depth * depth * depth);
}

}  // namespace

Ray WorldCamera::ray(const Vec2<float>& raster, const Vec2<float>&) const {
  const float right = (2 * camera_.inverse_width * raster.x - 1) * camera_.tan_x;
  const float up = (1 - 2 * camera_.inverse_height * raster.y) * camera_.tan_y;
  const Vec3f through = camera_.forward + camera_.right * right + camera_.up * up;
  return {camera_.origin + through * camera_.near, normalize(through)};
}

std::optional<CameraSeen> WorldCamera::connect(const Vec3f& p, const Vec2<float>&) const {
  const Vec3f d = p - camera_.origin;
  const float depth = dot(d, camera_.forward);
  if (!(depth > camera_.near) || depth > camera_.far) return std::nullopt;
  const float right = dot(d, camera_.right) / (depth * camera_.tan_x);
  const float up = dot(d, camera_.up) / (depth * camera_.tan_y);
  CameraSeen seen;
  seen.end.p = camera_.origin + d * (camera_.near / depth);
  seen.wi = -normalize(d);
  seen.density = pinhole_density(camera_, d);
  seen.raster = {(right + 1) / (2 * camera_.inverse_width), (1 - up) / (2 * camera_.inverse_height)};
  return seen;
}

float WorldCamera::density(const Ray&, const Vec3f& p) const { return pinhole_density(camera_, p - camera_.origin); }

Vec2<float> place_in_pixel(const Draws& draws, int grid, std::uint32_t dimension) {
  if (grid <= 0) return draws.two(dimension);
  const auto k = static_cast<std::uint32_t>(grid);
  const std::uint32_t cell = draws.index % (k * k);
  const auto middle = [&](std::uint32_t i) { return (static_cast<float>(i) + 0.5f) / static_cast<float>(k); };
  return {middle(cell % k), middle(cell / k)};
}

}  // namespace photonproof
