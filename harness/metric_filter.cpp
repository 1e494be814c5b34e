#include "harness/metric_filter.h"

#include <algorithm>
#include <cmath>

namespace photonproof {

Kernel gaussian_kernel(double sigma, int radius) {
  Kernel kernel;
  double sum = 0;
  for (int x = -radius; x <= radius; ++x) {
    kernel.push_back(std::exp(-x * x / (2 * sigma * sigma)));
    sum += kernel.back();
  }
  for (double& weight : kernel) weight /= sum;
  return kernel;
}

// Both passes add one weighted row at a time, so that the inner loop runs along x, where it vectorises, and every pixel
// still sums its terms in the kernel's order.

Plane filter_rows(const Plane& plane, const Kernel& kernel) {
  const auto width = static_cast<std::size_t>(plane.width);
  const std::size_t radius = kernel.size() / 2;
  Plane result(plane.width, plane.height);
  std::vector<double> padded(width + 2 * radius);
  for (std::size_t begin = 0; begin < plane.values.size(); begin += width) {
    const double* row = plane.values.data() + begin;
    std::fill_n(padded.begin(), radius, row[0]);
    std::copy_n(row, width, padded.begin() + static_cast<std::ptrdiff_t>(radius));
    std::fill_n(padded.end() - static_cast<std::ptrdiff_t>(radius), radius, row[width - 1]);
    double* out = result.values.data() + begin;
    for (std::size_t k = 0; k < kernel.size(); ++k) {
      const double weight = kernel[k];
      const double* in = padded.data() + k;
      for (std::size_t x = 0; x < width; ++x) out[x] += weight * in[x];
    }
  }
  return result;
}

Plane filter_columns(const Plane& plane, const Kernel& kernel) {
  const auto width = static_cast<std::size_t>(plane.width);
  const int radius = static_cast<int>(kernel.size() / 2);
  Plane result(plane.width, plane.height);
  for (int y = 0; y < plane.height; ++y) {
    double* out = result.values.data() + static_cast<std::size_t>(y) * width;
    for (std::size_t k = 0; k < kernel.size(); ++k) {
      const double weight = kernel[k];
      const int source = std::clamp(y + static_cast<int>(k) - radius, 0, plane.height - 1);
      const double* in = plane.values.data() + static_cast<std::size_t>(source) * width;
      for (std::size_t x = 0; x < width; ++x) out[x] += weight * in[x];
    }
  }
  return result;
}

}  // namespace photonproof
