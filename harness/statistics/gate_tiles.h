// The places where an image deviates, with one sentence each. Neighbouring blocks that deviate in the same direction
// make one place, which is cut down to the pixels that cause the deviation.
#pragma once

#include <functional>
#include <vector>

#include "harness/statistics/deviations.h"
#include "reports/record/results.h"

namespace photonproof::inline harness_statistics {

/// A block's deviation beyond the allowed one in a channel, in standard errors; 0 where it is within.
using BlockScore = std::function<double(std::size_t block, std::size_t channel)>;

/// Worst first. Sentences read "-6.1 % over 41 px at (12, 40), red only".
std::vector<FailingTile> failing_tiles(const Deviations& deviations, const BlockScore& score);

/// "red", "green and blue", "" for all three.
std::string channel_names(const std::array<bool, 3>& channels);

/// "+6.1 %", of the reference; "+0.013 (reference 0)" where that is black.
std::string relative_text(double difference, double expected);

}  // namespace photonproof::inline harness_statistics
