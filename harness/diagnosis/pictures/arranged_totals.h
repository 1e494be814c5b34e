// The excess of a picture that is turned over, its channels exchanged and its values encoded, in every combination.
// Values are encoded once for all turns and channels; no picture is made.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "harness/diagnosis/pictures/comparison.h"
#include "scenes/images/image.h"

namespace photonproof::inline harness_diagnosis_pictures {

class ArrangedTotals {
 public:
  /// `picture` is linear and unchanged; it and `comparison` must outlive this.
  ArrangedTotals(const Image& picture, const Comparison& comparison) : picture_(picture), comparison_(comparison) {}

  /// Sets the row of tone_rows() for total().
  void encode(std::size_t tone);
  /// Comparison::total of the picture changed by these rows of turn_rows() and channel_rows().
  double total(std::size_t turn, std::size_t channels, double most) const;

 private:
  const Image& picture_;
  const Comparison& comparison_;
  std::vector<float> colours_, greys_;  ///< Values to compare: 3 values a pixel, and one.
  float black_ = 0;
};

}  // namespace photonproof::inline harness_diagnosis_pictures
