#include "harness/pixels/likeness.h"

namespace photonproof::inline harness_pixels {
namespace {

constexpr double share_of_variance = 0.25;
// Least ratio of the variance to that of rounding, step^2/12 on each side.
constexpr double least_noise_to_rounding = 8;

}  // namespace

bool has_noise_of(const Image& image, const Image& other, const Image& variance, double step) {
  double squares = 0, expected = 0, rounding = 0;
  for (std::size_t i = 0; i < image.rgb.size(); ++i) {
    const double v = double{variance.rgb[i]};
    if (v <= 0) continue;  // clamped, or without noise
    const double difference = double{image.rgb[i]} - double{other.rgb[i]};
    squares += difference * difference;
    expected += v;
    rounding += step * step / 12;
  }
  return expected > 0 && expected >= least_noise_to_rounding * rounding && squares < share_of_variance * expected;
}

}  // namespace photonproof::inline harness_pixels
