// The compiled camera as kernels and light tracing see it. Raster coordinates are pixels of the whole film from its top
// left corner, pixel (x, y) from x to x + 1.
#pragma once

#include <array>
#include <cstdint>

#include "scenes/base/vec.h"

namespace photonproof::inline renderer_sensor {

/// The last ones measure: parallel rays from a patch of a plane, and rays in all directions before it by their cosine.
/// A batch is several cameras side by side.
enum class CameraKind : std::uint32_t { perspective, thin_lens, orthographic, fisheye, parallel, irradiance, batch };

/// Whether rays need two random numbers beside their place on the film.
inline bool takes_lens_point(CameraKind kind) {
  return kind == CameraKind::thin_lens || kind >= CameraKind::irradiance;
}

/// The two parts of a filter with negative lobes: its values above and below 0 (negative_lobes.h).
enum class FilterPart : std::uint32_t { positive, negative };

/// A pixel's weight of the image around its middle: separable, symmetric. Samples are drawn with that density, so that
/// all weigh the same. With negative lobes, the samples of a part are drawn with the part's density.
struct FilterView {
  /// Quantiles of the distance along an axis, at 1 - sqrt(1 - u) = i / steps for u uniform: finer where tails are thin.
  static constexpr std::uint32_t steps = 128;
  bool is_box = true;  ///< the pixel itself
  float radius = 0.5f;
  float margin = 0;  ///< reach beyond the film's border from which light paths are splatted
  std::array<float, steps + 1> quantiles{};
  /// The share of samples that would fall beyond one border of the film, by the pixel's distance from it; they are
  /// sampled within. All zero when the border is sampled. Filters reach 16 pixels (view_description.h).
  static constexpr std::uint32_t widest = 16;
  std::array<float, widest + 1> beyond_border{};

  /// With negative lobes: for each sign along an axis, the share of its lobes up to the distance cell / `cells` of the
  /// radius, and beyond borders. The positive lobes come first.
  static constexpr std::uint32_t cells = 256;
  bool has_lobes = false;
  float negative_integral = 0;  ///< of an axis's negative lobes; the positive ones have 1 more
  std::array<float, 2 * (cells + 1)> lobes{};
  std::array<float, 2 * (widest + 1)> lobes_beyond_border{};
  FilterView() = default;
};

struct CameraView {
  Vec3f origin, right, up, forward;  ///< axes unit, but of meters
  /// Half the image at the distance 1: for an orthographic camera in scene units, for a fisheye in radians; 0 where all
  /// rays are one.
  float tan_x = 1, tan_y = 1;
  float inverse_width = 1, inverse_height = 1;  ///< of the film in pixels
  float near = 0, far = 0;                      ///< Distances along `forward`; for a fisheye along rays.
  float center_x = 1, center_y = 1;             ///< Twice the axis's place on the film, in its widths and heights.
  float width = 1, height = 1;                  ///< of the film in pixels
  CameraKind kind = CameraKind::perspective;
  float lens_radius = 0, focus_distance = 1;  ///< thin lens; the sharp plane's distance along `forward`
  float max_angle = 0;                        ///< fisheye: beyond it there is no image
  bool is_round = false;                      ///< the patch of a meter, whose half axes are `right` and `up`
  std::uint32_t part_count = 0;
  const CameraView* parts = nullptr;  ///< cameras of a batch from left to right; owned by the scene
  double image_factor = 1;            ///< of every pixel
  FilterView filter;
};

}  // namespace photonproof::inline renderer_sensor
