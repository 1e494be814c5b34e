#include "harness/metrics/metric_windows.h"

#include <algorithm>
#include <cmath>

#include "harness/pixels/metric_filter.h"
#include "harness/pixels/pixel_loops.h"

namespace photonproof::inline harness_metrics {

namespace {

const Taps& window_taps() {
  static const Taps taps = gaussian_taps(1.5, ssim_radius);
  return taps;
}

}  // namespace

SimilarityRows::SimilarityRows(const TilePlane& reference, const TilePlane& test, std::size_t width, TileMemory& memory)
    : row_r_(reference.core - ssim_radius * reference.stride - ssim_radius),
      row_x_(test.core - ssim_radius * test.stride - ssim_radius),
      stride_r_(reference.stride),
      stride_x_(test.stride),
      width_(width),
      ssim_(memory.take<double>(width)),
      structure_(memory.take<double>(width)) {
  for (std::size_t m = 0; m < moments; ++m) {
    values_[m] = memory.take<double>(width + 2 * ssim_radius);
    means_[m] = memory.take<double>(width);
  }
  for (double*& row : across_) row = memory.take<double>(moments * width);
  while (read_ < ssim_window - 1) read_row();
}

void SimilarityRows::read_row() {
  const PixelLoops& loops = pixel_loops();
  loops.sum_and_difference(row_r_, row_x_, width_ + 2 * ssim_radius, values_[0], values_[1], values_[2], values_[3]);
  row_r_ += stride_r_;
  row_x_ += stride_x_;
  double* row = across_[read_++ % ssim_window];
  for (std::size_t m = 0; m < moments; ++m)
    loops.filter({values_[m] + ssim_radius, 0, 1, width_, 1}, {window_taps(), row + m * width_, 0});
}

void SimilarityRows::next() {
  read_row();
  const PixelLoops& loops = pixel_loops();
  for (std::size_t m = 0; m < moments; ++m) {
    const double* rows[ssim_window];
    for (std::size_t k = 0; k < ssim_window; ++k) rows[k] = across_[(read_ + k) % ssim_window] + m * width_;
    loops.filter_rows(rows, window_taps(), width_, means_[m]);
  }
  loops.similarity(means_[0], means_[1], means_[2], means_[3], width_, ssim_, structure_);
}

InnerRange inner_range(int start, int length, int size) {
  return {std::clamp(ssim_radius - start, 0, length), std::clamp(size - ssim_radius - start, 0, length)};
}

void halve(const TilePlane& plane, std::size_t out_width, std::size_t out_height, double* out, std::size_t out_stride) {
  for (std::size_t y = 0; y < out_height; ++y) {
    const double* upper = plane.core + 2 * y * plane.stride;
    const double* lower = upper + plane.stride;
    for (std::size_t x = 0; x < out_width; ++x)
      out[y * out_stride + x] = 0.25 * ((upper[2 * x] + upper[2 * x + 1]) + (lower[2 * x] + lower[2 * x + 1]));
  }
}

}  // namespace photonproof::inline harness_metrics
