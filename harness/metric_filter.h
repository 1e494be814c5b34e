// Separable filters over one channel, with replicated borders.
#pragma once

#include <cstddef>
#include <vector>

namespace photonproof {

/// One channel, row-major.
struct Plane {
  int width = 0;
  int height = 0;
  std::vector<double> values;  ///< size width * height

  Plane(int w, int h) : width(w), height(h), values(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
};

/// Odd number of weights, the middle one at the pixel itself: result(x) = sum_k weights[k] * value(x + k - radius).
using Kernel = std::vector<double>;

/// exp(-x^2 / (2 sigma^2)) at x = -radius ... radius, scaled to sum to 1.
Kernel gaussian_kernel(double sigma, int radius);

/// Along x or along y. Outside the plane the nearest border value stands.
Plane filter_rows(const Plane& plane, const Kernel& kernel);
Plane filter_columns(const Plane& plane, const Kernel& kernel);

}  // namespace photonproof
