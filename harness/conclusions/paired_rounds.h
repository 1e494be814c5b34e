// Is one program slower or less accurate than another? In each round the old program, the new one and the old one again
// work on the same cell with the same seed. The three run at once on one processor. The kernel interleaves them every
// few milliseconds, so other work slows all of them alike (Bulej et al. 2020, "Duet benchmarking"). Their processor
// times are compared; the old program against itself is the control.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "reports/record/results.h"

namespace photonproof::inline harness_conclusions {

struct PairedRound {
  double old_seconds = 0, new_seconds = 0, again_seconds = 0;  ///< user + system, positive
  /// relmse against the scene's reference; absent where there is none.
  std::optional<double> old_relmse, new_relmse;
  bool same_image = false;  ///< the old and the new one, to the bit
};

/// A ratio is judged once its interval lies on one side of these, or between them.
struct ChangeThresholds {
  double seconds = 0.015;  ///< of 1: half of the 3 % to be found, so that 0 and 3 % are equally easy to decide
  double relmse = 0.05;
  std::size_t least_rounds = 6;  ///< the fewest whose median has a 95 % interval
};

struct RatioVerdict {
  Estimate ratio;                   ///< new / old
  std::optional<Interval> control;  ///< old / old
  Change change = Change::inconclusive;
  std::string reason;  ///< why inconclusive, or "" otherwise
};

/// Median ratio of the new processor time to the mean of both old ones, with its 95 % interval. Inconclusive while the
/// interval holds a threshold, while the control's interval excludes 1, or with too few rounds. More rounds may then
/// decide.
RatioVerdict judge_seconds(std::span<const PairedRound> rounds, const ChangeThresholds& thresholds = {});

/// Ratio of mean relmse, with an interval by the jackknife over rounds. Equal images in every round are `unchanged` at
/// once. Empty where a round has no relmse.
std::optional<RatioVerdict> judge_relmse(std::span<const PairedRound> rounds, const ChangeThresholds& thresholds = {});

/// The side of 1 +- threshold on which the interval lies; inconclusive when it holds either end.
Change side_of(const Interval& ratio, double threshold);

/// "1.031 (95 % interval 1.027 to 1.036)".
std::string ratio_text(const Estimate& ratio);

}  // namespace photonproof::inline harness_conclusions
