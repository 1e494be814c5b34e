// The window statistics behind ssim and ms_ssim: Wang, Bovik, Sheikh, Simoncelli, "Image quality assessment: from error
// visibility to structural similarity", 2004, eq. 13, over an 11 x 11 Gaussian window of sigma 1.5, on values in [0,1].
// Instead of r and x the windows average s = r + x and d = r - x, whose moments say the same with one filter fewer.
#pragma once

#include <cstddef>

#include "harness/pair_tile.h"

namespace photonproof {

inline constexpr int ssim_radius = 5;   ///< int(3.5 sigma + 0.5): scikit-image's truncation
inline constexpr int ssim_window = 11;  ///< 2 ssim_radius + 1

/// Pixels of a tile row by row; `width` a row.
struct SimilarityMaps {
  double* ssim;       ///< luminance, contrast and structure
  double* structure;  ///< contrast and structure alone
};

/// Of the width x height pixels from each plane's core on, around which ssim_radius more are there.
SimilarityMaps similarity_maps(const TilePlane& reference, const TilePlane& test, std::size_t width, std::size_t height,
                               TileMemory& memory);

/// The tile's columns or rows whose window lies wholly inside an image of `size`: [first, end) of its `length` from
/// `start` on.
struct InnerRange {
  int first, end;
};
InnerRange inner_range(int start, int length, int size);

/// Means of 2 x 2 values of a plane: the pixel (i, j) of `out` is the mean of (2i, 2j) ... (2i+1, 2j+1).
void halve(const TilePlane& plane, std::size_t out_width, std::size_t out_height, double* out, std::size_t out_stride);

}  // namespace photonproof
