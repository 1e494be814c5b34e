#include "harness/pixels/metric_filter.h"

#include <cmath>

namespace photonproof::inline harness_pixels {

Taps gaussian_taps(double sigma, int radius) {
  Taps taps{radius, {}};
  double sum = 0;
  for (int k = 0; k <= radius; ++k) {
    taps.weight[k] = std::exp(-k * k / (2 * sigma * sigma));
    sum += k == 0 ? taps.weight[k] : 2 * taps.weight[k];
  }
  for (double& weight : taps.weight) weight /= sum;
  return taps;
}

}  // namespace photonproof::inline harness_pixels
