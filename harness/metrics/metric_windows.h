// The window statistics behind ssim and ms_ssim, for values in [0,1]: Wang, Bovik, Sheikh, Simoncelli, "Image quality
// assessment: from error visibility to structural similarity", 2004, eq. 13. The window is an 11 x 11 Gaussian of sigma
// 1.5. It averages s = r + x and d = r - x instead of r and x: same information, one filter fewer.
#pragma once

#include <cstddef>

#include "harness/pixels/pair_tile.h"

namespace photonproof::inline harness_metrics {

inline constexpr int ssim_radius = 5;   ///< int(3.5 sigma + 0.5): scikit-image's truncation
inline constexpr int ssim_window = 11;  ///< 2 ssim_radius + 1
static_assert(ssim_radius <= PairTile::encoded_reach);

/// The similarity of `width` pixels, one row after the other. The moments of the last 11 rows are kept, filtered along
/// the row, so that all of them stay in the processor's nearest caches.
class SimilarityRows {
 public:
  /// Starts at the row of each plane's core, which has ssim_radius more values around it. The planes and the memory
  /// must outlive it.
  SimilarityRows(const TilePlane& reference, const TilePlane& test, std::size_t width, TileMemory& memory);

  /// Moves to the next row; before the first call there is none.
  void next();
  const double* ssim() const { return ssim_; }            ///< luminance, contrast and structure
  const double* structure() const { return structure_; }  ///< contrast and structure only

 private:
  static constexpr std::size_t moments = 4;  // means of s, d, s^2, d^2
  void read_row();

  const double *row_r_, *row_x_;  // the next rows to be read
  std::size_t stride_r_, stride_x_, width_;
  double *values_[moments], *means_[moments], *ssim_, *structure_;
  double* across_[ssim_window];  // the moments of one row, one after the other
  std::size_t read_ = 0;
};

/// The tile's columns or rows whose window lies wholly inside an image of `size`: [first, end) of its `length` from
/// `start` on.
struct InnerRange {
  int first, end;
  std::size_t count() const { return static_cast<std::size_t>(end - first); }
};
InnerRange inner_range(int start, int length, int size);

/// Means of 2 x 2 values of a plane: the pixel (i, j) of `out` is the mean of (2i, 2j) ... (2i+1, 2j+1).
void halve(const TilePlane& plane, std::size_t out_width, std::size_t out_height, double* out, std::size_t out_stride);

}  // namespace photonproof::inline harness_metrics
