// The transfer function of sRGB, IEC 61966-2-1.
#pragma once

#include <cmath>

namespace photonproof::inline scenes_base {

/// Linear light of an encoded value in [0,1].
inline double decode_srgb(double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); }

}  // namespace photonproof::inline scenes_base
