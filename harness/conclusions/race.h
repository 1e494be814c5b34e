// Race: the times that a scene's engines take to reach the same error.
#pragma once

#include <vector>

#include "reports/record/results.h"

namespace photonproof::inline harness_conclusions {

/// One record for each scene on which the order of two engines or more is known, in the order of the curves. The error
/// is that of one engine's largest budget. It is the one that most engines reach between two budgets; ties go to the
/// most pairs of known order, then to the least error. An engine with several kinds of budget counts with its fastest.
/// Times are those of time_to_target (convergence.h): interpolated, or a bound. A bound has a rank only where it
/// settles the order: "at most 3 s" is neither faster nor slower than 2 s.
std::vector<RaceRecord> races_of(const std::vector<Convergence>& curves);

}  // namespace photonproof::inline harness_conclusions
