// A shift by less than the blocks of a comparison show. The picture's difference D is fitted with the slopes of the
// expected picture, D = -(dx dI/dx + dy dI/dy), by least squares over all pixels. Edges of one ray a pixel move by a
// whole pixel or not at all; over many of them the mean is the shift.
#pragma once

#include <optional>

#include "harness/diagnosis/pictures/comparison.h"

namespace photonproof::inline harness_diagnosis {

struct SubPixelShift {
  double x = 0, y = 0;    ///< Pixels right and down.
  double explained = 0;   ///< Share of the squared difference beyond noise.
  double deviations = 0;  ///< Deviations from no shift.
};

/// `expected` is linear. Empty where the parts of the picture do not agree on one shift, or it is not far above its
/// uncertainty.
std::optional<SubPixelShift> sub_pixel_shift(const Image& expected, const Comparison& comparison);

}  // namespace photonproof::inline harness_diagnosis
