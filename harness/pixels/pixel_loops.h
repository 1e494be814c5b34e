// Loops over pixels that take most of the time of ssim, ms_ssim and flip, compiled once for each instruction set. The
// compiler vectorises plain loops without contraction and reassociation, so all sets give the same bits.
#pragma once

#include <cstddef>
#include <cstdint>

namespace photonproof::inline harness_pixels {

/// A kernel of odd length along one axis by half of it: weight[k] at distance k, up to radius.
struct Taps {
  static constexpr int greatest_radius = 10;
  int radius = 0;
  double weight[greatest_radius + 1] = {};
};

/// Input of a filter. `in` is the value under the first result's middle tap. `step` is the distance of neighbouring
/// taps: 1 along a row, in_stride along a column.
struct FilterSpan {
  const double* in;
  std::size_t in_stride;
  std::ptrdiff_t step;
  std::size_t width, height;
};
/// Where the filter writes one of its results.
struct FilterResult {
  const Taps& taps;
  double* out;
  std::size_t out_stride;
};

/// L*, a*, b* of n pixels each.
struct LabPlanes {
  double *l, *a, *b;
};
/// Magnitudes of the two feature detectors.
struct FeaturePlanes {
  double *edge, *point;
};
/// FLIP's errors count in steps of 2^-22, a float's last bits below 1: sums of them are exact in any order.
inline constexpr std::uint32_t flip_steps = std::uint32_t{1} << 22;

struct PixelLoops {
  const char* isa;
  void (*split_rgb)(const float* rgb, std::size_t n, float* r, float* g, float* b);
  /// clamp(scale * v, 0, 1), still linear.
  void (*expose)(const float* linear, std::size_t n, double scale, double* out);
  /// ACES of scale * clamp(v, 0, 65536), clamped to [0, 1]: still linear (metric_hdr_flip.cpp).
  void (*tone_map)(const float* linear, std::size_t n, double scale, double* out);
  /// The sRGB transfer of values in [0, 1], within 1e-14 of the exact one.
  void (*encode)(const double* linear, std::size_t n, double* out);
  /// Even kernels, sum_k weight[k] (in[-k] + in[k]) with the middle once, of radius 5, 7, 9 or 10.
  void (*filter)(const FilterSpan& span, const FilterResult& even);
  /// The same down the columns of 2 radius + 1 rows, which need not be adjacent in memory; radius 5.
  void (*filter_rows)(const double* const* rows, const Taps& even, std::size_t width, double* out);
  /// Two kernels on the same values: even ones of radius 10; or, of radius 9, an odd one, sum_k weight[k] (in[k] -
  /// in[-k]), and an even one.
  void (*filter_twice)(const FilterSpan& span, const FilterResult& even, const FilterResult& other_even);
  void (*filter_odd_even)(const FilterSpan& span, const FilterResult& odd, const FilterResult& even);

  /// s = r + x, d = r - x and their squares.
  void (*sum_and_difference)(const double* r, const double* x, std::size_t n, double* s, double* d, double* ss,
                             double* dd);
  /// From the window means: luminance term times contrast and structure, and the latter alone (metric_ssim.cpp).
  void (*similarity)(const double* s, const double* d, const double* ss, const double* dd, std::size_t n, double* ssim,
                     double* structure);

  /// y, x - y and y - z of XYZ relative to white (metric_flip_map.cpp).
  void (*opponents)(const double* r, const double* g, const double* b, std::size_t n, double* y, double* xy,
                    double* yz);
  /// Hunt-adjusted L*a*b* of filtered opponents, clamped to displayable colours; yz = share wide + (1 - share) narrow.
  void (*perceived)(const double* y, const double* xy, const double* wide, const double* narrow, double share,
                    std::size_t n, LabPlanes lab);
  void (*magnitude)(const double* a, const double* b, std::size_t n, double* out);
  /// FLIP in steps. `greatest` is the greatest HyAB distance to the power 0.7.
  void (*flip_error)(LabPlanes a, LabPlanes b, FeaturePlanes features_a, FeaturePlanes features_b, double greatest,
                     std::size_t n, std::uint32_t* steps);
};

/// The loops for the best instruction set this processor has.
const PixelLoops& pixel_loops();
/// All loops that this processor can run, best first.
const PixelLoops* const* available_pixel_loops();  ///< ends with a null pointer

}  // namespace photonproof::inline harness_pixels
