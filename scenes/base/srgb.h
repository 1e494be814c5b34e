// The transfer function of sRGB and its inverse, IEC 61966-2-1, both from [0,1] to [0,1].
#pragma once

#include <cmath>

namespace photonproof::inline scenes_base {

inline double encode_srgb(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

inline double decode_srgb(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

}  // namespace photonproof::inline scenes_base
