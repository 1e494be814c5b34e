// The brightest sample that any block met. Other blocks may have missed one as bright, at most in proportion to their
// brightness (see deviation.h).
#pragma once

#include <algorithm>

namespace photonproof::inline harness_statistics {

struct BrightestSample {
  double of_channel = 0, of_block = 0;  ///< relative to the channel's mean, and to the block's
  /// Records a sample that adds this much to a pixel of a block. The brightnesses are means over pixels.
  void add(double sample, double of_the_block, double of_the_channel) {
    if (of_the_channel > 0) of_channel = std::max(of_channel, sample / of_the_channel);
    if (of_the_block > 0) of_block = std::max(of_block, sample / of_the_block);
  }
  /// The amount that an equally bright sample, which a block may have missed, adds to a pixel.
  double missed_by(double block, double channel) const { return std::min(of_channel * channel, of_block * block); }
};

}  // namespace photonproof::inline harness_statistics
