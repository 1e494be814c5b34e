// Where an image is off: neighbouring blocks that are off the same way make one place, cut down to the pixels that
// carry the deviation, with one sentence each.
#pragma once

#include <functional>
#include <vector>

#include "harness/statistics/deviations.h"
#include "reports/record/results.h"

namespace photonproof::inline harness_statistics {

/// How far a block is beyond what is allowed in a channel, in standard errors; 0 where it is not.
using BlockScore = std::function<double(std::size_t block, std::size_t channel)>;

/// Worst first. Sentences read "-6.1 % over 41 px at (12, 40), red only".
std::vector<FailingTile> failing_tiles(const Deviations& deviations, const BlockScore& score);

/// "red", "green and blue", "" for all three.
std::string channel_names(const std::array<bool, 3>& channels);

/// "+6.1 %", of the reference; "+0.013 (reference 0)" where that is black.
std::string relative_text(double difference, double expected);

}  // namespace photonproof::inline harness_statistics
