#include "harness/metric_windows.h"

#include <algorithm>
#include <cmath>

#include "harness/metric_filter.h"
#include "harness/pixel_loops.h"

namespace photonproof {

SimilarityMaps similarity_maps(const TilePlane& reference, const TilePlane& test, std::size_t width, std::size_t height,
                               TileMemory& memory) {
  static const Taps taps = gaussian_taps(1.5, ssim_radius);
  constexpr std::size_t r = ssim_radius;
  const PixelLoops& loops = pixel_loops();
  SimilarityMaps maps{memory.take<double>(width * height), memory.take<double>(width * height)};
  const TileMemory::Frame frame(memory);
  const std::size_t stride = width + 2 * r;
  double *moments[4], *across[4], *means[4];
  for (std::size_t m = 0; m < 4; ++m) {
    moments[m] = memory.take<double>(stride * (height + 2 * r));
    across[m] = memory.take<double>(width * (height + 2 * r));
    means[m] = memory.take<double>(width * height);
  }
  for (std::size_t y = 0; y < height + 2 * r; ++y) {
    const double* row_r = reference.core + y * reference.stride - r * reference.stride - r;
    const double* row_x = test.core + y * test.stride - r * test.stride - r;
    loops.sum_and_difference(row_r, row_x, stride, moments[0] + y * stride, moments[1] + y * stride,
                             moments[2] + y * stride, moments[3] + y * stride);
  }
  for (std::size_t m = 0; m < 4; ++m) {
    loops.filter({moments[m] + r, stride, 1, width, height + 2 * r}, {taps, across[m], width});
    loops.filter({across[m] + r * width, width, static_cast<std::ptrdiff_t>(width), width, height},
                 {taps, means[m], width});
  }
  loops.similarity(means[0], means[1], means[2], means[3], width * height, maps.ssim, maps.structure);
  return maps;
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

}  // namespace photonproof
