#include "harness/pixels/display.h"

#include <algorithm>
#include <cmath>

namespace photonproof::inline harness_pixels {

double encode_srgb(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

double decode_srgb(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

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
