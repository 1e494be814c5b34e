// What a picture leaves unexplained when it is turned over, its channels exchanged and its values encoded, in every
// combination: values are encoded once for all turns and channels, and no picture is made.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "harness/diagnosis/pictures/comparison.h"
#include "scenes/images/image.h"

namespace photonproof::inline harness_diagnosis_pictures {

class ArrangedTotals {
 public:
  /// `picture` is linear, and as it is before any of this; both stay where they are.
  ArrangedTotals(const Image& picture, const Comparison& comparison) : picture_(picture), comparison_(comparison) {}

  /// The row of tone_rows() that total() goes by.
  void encode(std::size_t tone);
  /// Comparison::total of it by rows of turn_rows() and channel_rows().
  double total(std::size_t turn, std::size_t channels, double most) const;

 private:
  const Image& picture_;
  const Comparison& comparison_;
  std::vector<float> colours_, greys_;  ///< as they are compared: 3 values a pixel, and one
  float black_ = 0;
};

}  // namespace photonproof::inline harness_diagnosis_pictures
