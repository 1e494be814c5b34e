#include "renderer/sensor/camera_connection.h"

#include <cmath>

#include "renderer/lanes/warp.h"

namespace photonproof::inline renderer_sensor {
namespace {

/// Area of a pixel at the distance 1 along the axis; of the orthographic camera anywhere, of a fisheye in radians^2.
float pixel_area(const CameraView& camera) {
  return 4 * camera.tan_x * camera.inverse_width * camera.tan_y * camera.inverse_height;
}

/// Raster area per solid angle of rays in `direction`.
float raster_per_solid_angle(const CameraView& camera, const Vec3f& direction) {
  const float cosine = dot(direction, camera.forward);
  if (camera.kind == CameraKind::fisheye) {
    const float angle = angle_between(camera.forward, direction);
    if (angle > camera.max_angle) return 0;
    const float sine = std::sin(angle);
    return (sine > 1e-6f ? angle / sine : 1) / pixel_area(camera);
  }
  return cosine > 0 ? 1 / (pixel_area(camera) * cosine * cosine * cosine) : 0;
}

}  // namespace

CameraConnection connect_to_camera(const CameraView& camera, const Vec3f& p, const Vec2<float>& u_lens) {
  CameraConnection c;
  if (camera.kind > CameraKind::fisheye || !(camera.tan_x > 0)) return c;  // meters and batches are not connected to
  const Vec3f d = p - camera.origin;
  const float along = dot(d, camera.forward);
  Vec2<float> plane;  // where the ray crosses the plane at distance 1, or the fisheye's angles
  float from_lens = 0, to_near = 0;
  if (camera.kind == CameraKind::fisheye) {
    from_lens = length(d);
    if (!(from_lens > camera.near) || from_lens > camera.far) return c;
    to_near = camera.near;
    c.direction = d / from_lens;
    const float angle = angle_between(camera.forward, c.direction);
    if (angle > camera.max_angle) return c;
    const float x = dot(c.direction, camera.right), y = dot(c.direction, camera.up), sine = std::hypot(x, y);
    const float scale = sine > 0 ? angle / sine : 0;
    plane = {x * scale, y * scale};
    c.origin = camera.origin + c.direction * to_near;
  } else {
    if (!(along > camera.near) || along > camera.far) return c;
    const float x = dot(d, camera.right), y = dot(d, camera.up);
    if (camera.kind == CameraKind::orthographic) {
      plane = {x, y};
      c.direction = camera.forward;
      from_lens = along;
      c.origin = p - camera.forward * (along - camera.near);
      to_near = camera.near;
    } else {
      Vec2<float> lens;
      if (camera.lens_radius > 0) {
        const Vec2<float> disc = square_to_disc(u_lens);
        lens = {disc.x * camera.lens_radius, disc.y * camera.lens_radius};
      }
      const float focus = camera.focus_distance;
      plane = {lens.x / focus + (x - lens.x) / along, lens.y / focus + (y - lens.y) / along};
      const Vec3f p_lens = camera.origin + camera.right * lens.x + camera.up * lens.y;
      from_lens = length(p - p_lens);
      c.direction = (p - p_lens) / from_lens;
      to_near = camera.near / along * from_lens;
      c.origin = p_lens + (p - p_lens) * (camera.near / along);
    }
  }
  c.raster = {(plane.x / camera.tan_x + camera.center_x) / (2 * camera.inverse_width),
              (camera.center_y - plane.y / camera.tan_y) / (2 * camera.inverse_height)};
  const float margin = camera.filter.margin;
  if (!(c.raster.x >= -margin && c.raster.x <= camera.width + margin && c.raster.y >= -margin &&
        c.raster.y <= camera.height + margin))
    return c;
  c.distance = from_lens - to_near;
  c.importance = camera.kind == CameraKind::orthographic
                     ? 1 / pixel_area(camera)
                     : raster_per_solid_angle(camera, c.direction) / (from_lens * from_lens);
  c.visible = c.importance > 0 && std::isfinite(c.importance);
  return c;
}

}  // namespace photonproof::inline renderer_sensor
