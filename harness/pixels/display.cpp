#include "harness/pixels/display.h"

#include <algorithm>
#include <cmath>

namespace photonproof::inline harness_pixels {

std::vector<double> expose(const Image& image, double exposure) {
  const double scale = std::exp2(exposure);
  std::vector<double> linear(image.rgb.size());
  for (std::size_t i = 0; i < linear.size(); ++i)
    linear[i] = std::clamp(scale * static_cast<double>(image.rgb[i]), 0.0, 1.0);
  return linear;
}

std::vector<double> encode_srgb(const std::vector<double>& linear) {
  std::vector<double> encoded(linear.size());
  for (std::size_t i = 0; i < linear.size(); ++i) encoded[i] = encode_srgb(linear[i]);
  return encoded;
}

}  // namespace photonproof::inline harness_pixels
