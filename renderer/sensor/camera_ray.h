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

/// One sign's lobes of a filter along an axis of the film, for each lane.
template <class F>
struct AxisLobes {
  F integral;      ///< within the film
  F below, above;  ///< shares beyond the film's borders
  UInt<F> table;   ///< start in FilterView::lobes

  AxisLobes(const FilterView& filter, const UInt<F>& at, float size, const Mask<F>& negative) {
    constexpr std::uint32_t widest = FilterView::widest;
    const auto beyond = [&](const UInt<F>& distance) {
      const UInt<F> within = select(as_mask<F>(distance < UInt<F>(widest)), distance, UInt<F>(widest));
      return gather(filter.lobes_beyond_border.data(),
                    UInt<F>(within + select(negative, UInt<F>(widest + 1), UInt<F>(0u))));
    };
    below = beyond(at);
    above = beyond(UInt<F>(static_cast<std::uint32_t>(size) - 1 - at));
    integral = select(negative, F(filter.negative_integral), F(1 + filter.negative_integral)) * (1 - below - above);
    table = select(negative, UInt<F>(FilterView::cells + 1), UInt<F>(0u));
  }

  /// Distance from the pixel's middle, sampled with the lobes' density.
  F offset(const FilterView& filter, const F& u) const {
    const F both = 2 * mul_add(u, F(1 - below - above), below) - 1;
    const F share = lane_min(F(lane_abs(both)), F(0x1.fffffep-1f));
    UInt<F> cell(0u);
    for (std::uint32_t step = FilterView::cells / 2; step > 0; step /= 2) {
      const UInt<F> next = cell + step;
      cell = select(gather(filter.lobes.data(), UInt<F>(table + next)) <= share, next, cell);
    }
    const F low = gather(filter.lobes.data(), UInt<F>(table + cell));
    const F high = gather(filter.lobes.data() + 1, UInt<F>(table + cell));
    const F part = lane_min(F((share - low) / lane_max(F(high - low), F(1e-30f))), F(1.0f));
    return lane_copysign(F((to_float(cell) + part) * (filter.radius / static_cast<float>(FilterView::cells))), both);
  }
};

/// Distances from the middle of the pixel (x, y), sampled with the density of a part of a filter with lobes. The filter
/// is the product of both axes' lobes, so lobes of the same sign make the positive part. One axis's sign is drawn.
template <class F>
Vec2<F> lobe_offsets(const CameraView& camera, const UInt<F>& x, const UInt<F>& y, FilterPart part, const Vec2<F>& u) {
  const FilterView& filter = camera.filter;
  const auto across = [&](const Mask<F>& negative) { return AxisLobes<F>(filter, x, camera.width, negative); };
  const auto down = [&](const Mask<F>& negative) { return AxisLobes<F>(filter, y, camera.height, negative); };
  const Mask<F> yes(true), no(false);
  const bool differ = part == FilterPart::negative;
  const F first = across(no).integral * down(differ ? yes : no).integral;
  const F second = across(yes).integral * down(differ ? no : yes).integral;
  const F share = first / lane_max(F(first + second), F(1e-30f));
  const Mask<F> negative_x = !(u.x < share);
  const F u_x = select(negative_x, F((u.x - share) / lane_max(F(1 - share), F(1e-30f))), F(u.x / share));
  const Mask<F> negative_y = differ ? Mask<F>(!negative_x) : negative_x;
  return {across(negative_x).offset(filter, lane_min(u_x, F(1.0f))), down(negative_y).offset(filter, u.y)};
}

template <class F>
void set_meter_ray(const CameraView& camera, const Vec2<F>& raster, const Vec2<F>& square, const Vec2<F>& u_direction,
                   CameraRay<F>& ray);
template <class F>
void set_ray_of_part(const CameraView& batch, const Vec2<F>& raster, const Vec2<F>& u_lens, CameraRay<F>& ray);

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
    case CameraKind::parallel:
    case CameraKind::irradiance:
      return set_meter_ray(camera, raster, {right, up}, u_lens, ray);
    case CameraKind::batch:
      return set_ray_of_part(camera, raster, u_lens, ray);
  }
}

/// Sets the ray that starts at a place of a meter's patch.
template <class F>
void set_meter_ray(const CameraView& camera, const Vec2<F>& raster, const Vec2<F>& square, const Vec2<F>& u_direction,
                   CameraRay<F>& ray) {
  const Vec2<F> place = camera.is_round
                            ? square_to_disc(Vec2<F>{raster.x * camera.inverse_width, raster.y * camera.inverse_height})
                            : square;
  const Vec3<F> forward = broadcast<F>(camera.forward);
  ray.origin = advance(advance(broadcast<F>(camera.origin), place.x, broadcast<F>(camera.right)), place.y,
                       broadcast<F>(camera.up));
  ray.direction = camera.kind == CameraKind::parallel
                      ? forward
                      : normalize(Frame<F>(forward).to_world(square_to_cosine_hemisphere(u_direction)));
}

/// Sets each lane's ray by the camera of the batch on whose columns its place lies.
template <class F>
void set_ray_of_part(const CameraView& batch, const Vec2<F>& raster, const Vec2<F>& u_lens, CameraRay<F>& ray) {
  const F across = raster.x * (batch.inverse_width * static_cast<float>(batch.part_count));
  for (std::uint32_t i = 0; i < batch.part_count; ++i) {
    const CameraView& camera = batch.parts[i];
    CameraRay<F> of_part;
    set_ray(camera, Vec2<F>{(across - static_cast<float>(i)) * camera.width, raster.y}, u_lens, of_part);
    const Mask<F> here = i == 0 ? as_mask<F>(true) : Mask<F>(across >= static_cast<float>(i));
    ray.origin = select(here, of_part.origin, ray.origin);
    ray.direction = select(here, of_part.direction, ray.direction);
    ray.valid = (here && of_part.valid) || (!here && ray.valid);
  }
}

/// Rays that end beyond the far plane hit nothing.
template <class F>
Mask<F> beyond_far_plane(const CameraView& camera, const Vec3<F>& p) {
  if (camera.kind == CameraKind::fisheye) return length(Vec3<F>(p - broadcast<F>(camera.origin))) > camera.far;
  return dot(Vec3<F>(p - broadcast<F>(camera.origin)), broadcast<F>(camera.forward)) > camera.far;
}

}  // namespace photonproof::inline renderer_sensor
