#include "renderer/scalar/scalar_camera.h"

#include "renderer/kernels/camera_rays.h"
#include "renderer/sensor/camera_connection.h"

namespace photonproof::inline renderer_scalar {
namespace {

/// Sampled from the reconstruction filter, or on the requested k x k grid.
Vec2<float> place_in_pixel(const CameraView& camera, int x, int y, const PathSampler& draws, int grid,
                           std::uint32_t dimension, FilterPart part) {
  if (grid > 0) {
    const auto k = static_cast<std::uint32_t>(grid);
    const std::uint32_t cell = draws.index % (k * k);
    const auto middle = [&](std::uint32_t i) { return (static_cast<float>(i) + 0.5f) / static_cast<float>(k); };
    return {middle(cell % k), middle(cell / k)};
  }
  const Vec2<float> u = draws.two(dimension);
  if (camera.filter.is_box) return u;
  if (camera.filter.has_lobes) {
    const Vec2<float> offsets =
        lobe_offsets<float>(camera, static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), part, u);
    return {0.5f + offsets.x, 0.5f + offsets.y};
  }
  const auto offset = [&](int at, float size, float drawn) {
    return filter_offset<float>(camera.filter, static_cast<std::uint32_t>(at), size, drawn);
  };
  return {0.5f + offset(x, camera.width, u.x), 0.5f + offset(y, camera.height, u.y)};
}

}  // namespace

std::optional<Ray> ScalarCamera::ray(int x, int y, const PathSampler& draws, int grid, std::uint32_t in_pixel,
                                     const Vec2<float>& u_lens, FilterPart part) const {
  const Vec2<float> place = place_in_pixel(camera_, x, y, draws, grid, in_pixel, part);
  CameraRay<float> ray;
  set_ray<float>(camera_, {static_cast<float>(x) + place.x, static_cast<float>(y) + place.y}, u_lens, ray);
  if (!ray.valid) return std::nullopt;
  return Ray{ray.origin, ray.direction};
}

std::optional<CameraSeen> ScalarCamera::connect(const Vec3f& p, const Vec2<float>& u_lens) const {
  const CameraConnection c = connect_to_camera(camera_, p, u_lens);
  if (!c.visible || !(c.importance > 0)) return std::nullopt;
  CameraSeen seen;
  seen.end.p = c.origin;
  seen.wi = -c.direction;
  seen.density = c.importance / rays_;
  seen.raster = c.raster;
  return seen;
}

float ScalarCamera::density(const Vec3f& p, const Vec2<float>& u_lens) const {
  return connect_to_camera(camera_, p, u_lens).importance / rays_;
}

bool ScalarCamera::beyond_far_plane(const Vec3f& p) const { return photonproof::beyond_far_plane<float>(camera_, p); }

}  // namespace photonproof::inline renderer_scalar
