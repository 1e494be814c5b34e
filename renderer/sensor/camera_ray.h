// The camera's rays, one per lane.
#pragma once

#include "renderer/lanes/warp.h"
#include "renderer/sensor/camera_view.h"

namespace photonproof::inline renderer_sensor {

template <class F>
struct CameraRay {
  Vec3<F> origin, direction;
  UInt<F> key{}, index{};  ///< of the sampler
  Mask<F> valid{};         ///< false where the camera has no image
};

/// Dimension of the sampler for the lens; vertices count theirs up from 1.
inline constexpr std::uint32_t lens_dimension = 0xFFFFFFFFu;

/// Distance from the pixel's middle along an axis, sampled with the filter's density.
template <class F>
F filter_offset(const FilterView& filter, const F& u) {
  const F both = 2 * u - 1;
  const F at = (1 - lane_sqrt(F(1 - lane_abs(both)))) * static_cast<float>(FilterView::steps);
  const UInt<F> below = to_uint(lane_min(at, F(static_cast<float>(FilterView::steps - 1))));
  const F low = gather(filter.quantiles.data(), below), high = gather(filter.quantiles.data() + 1, below);
  return lane_copysign(mul_add(F(at - to_float(below)), F(high - low), low), both);
}

/// The same for the pixel `at` of the film's `size` along an axis, limited to the film's borders.
template <class F>
F filter_offset(const FilterView& filter, const UInt<F>& at, float size, const F& u) {
  const auto beyond = [&](const UInt<F>& distance) {
    const UInt<F> widest(FilterView::widest);
    return gather(filter.beyond_border.data(), select(as_mask<F>(distance < widest), distance, widest));
  };
  const F low = beyond(at), high = beyond(UInt<F>(static_cast<std::uint32_t>(size) - 1 - at));
  return filter_offset(filter, F(mul_add(u, F(1.0f - low - high), low)));
}

/// Sets the ray through a point of the raster and, with a lens, through a point of that.
template <class F>
void set_ray(const CameraView& camera, const Vec2<F>& raster, const Vec2<F>& u_lens, CameraRay<F>& ray) {
  const F right = (2 * camera.inverse_width * raster.x - camera.center_x) * camera.tan_x;
  const F up = (camera.center_y - 2 * camera.inverse_height * raster.y) * camera.tan_y;
  const auto from = [&](const Vec3<F>& start, const F& along_right, const F& along_up) {
    return advance(advance(start, along_right, broadcast<F>(camera.right)), along_up, broadcast<F>(camera.up));
  };
  ray.valid = as_mask<F>(true);
  switch (camera.kind) {
    case CameraKind::perspective: {
      const Vec3<F> through = from(broadcast<F>(camera.forward), right, up);  // reaches the plane one unit ahead
      ray.origin = advance(broadcast<F>(camera.origin), F(camera.near), through);
      ray.direction = normalize(through);
      return;
    }
    case CameraKind::thin_lens: {
      const Vec2<F> disc = square_to_disc(u_lens);
      const F lens_right = disc.x * camera.lens_radius, lens_up = disc.y * camera.lens_radius;
      // From the lens point to the plane one unit ahead, towards the same point of the plane in focus.
      const float closer = 1 / camera.focus_distance;
      const Vec3<F> through =
          from(broadcast<F>(camera.forward), F(right - lens_right * closer), F(up - lens_up * closer));
      ray.origin = advance(from(broadcast<F>(camera.origin), lens_right, lens_up), F(camera.near), through);
      ray.direction = normalize(through);
      return;
    }
    case CameraKind::orthographic:
      ray.direction = broadcast<F>(camera.forward);
      ray.origin = advance(from(broadcast<F>(camera.origin), right, up), F(camera.near), ray.direction);
      return;
    case CameraKind::fisheye: {
      const F angle = lane_sqrt(F(right * right + up * up));
      ray.valid = angle <= camera.max_angle;
      const F within = lane_min(angle, F(camera.max_angle));
      const SinCos<F> turned = sincos_turn(F(within * (1 / (2 * pi))));
      const F scale = turned.sin / select(angle > 0, angle, F(1.0f));
      ray.direction =
          normalize(from(Vec3<F>(broadcast<F>(camera.forward) * turned.cos), F(right * scale), F(up * scale)));
      ray.origin = advance(broadcast<F>(camera.origin), F(camera.near), ray.direction);
      return;
    }
  }
}

/// Rays that end beyond the far plane hit nothing.
template <class F>
Mask<F> beyond_far_plane(const CameraView& camera, const Vec3<F>& p) {
  if (camera.kind == CameraKind::fisheye) return length(Vec3<F>(p - broadcast<F>(camera.origin))) > camera.far;
  return dot(Vec3<F>(p - broadcast<F>(camera.origin)), broadcast<F>(camera.forward)) > camera.far;
}

}  // namespace photonproof::inline renderer_sensor
