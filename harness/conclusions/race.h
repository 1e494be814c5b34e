// Who is faster at equal error: the times that a scene's engines take to one error.
#pragma once

#include <vector>

#include "reports/record/results.h"

namespace photonproof::inline harness_conclusions {

/// One record for each scene on which the order of two engines or more is known, in the order of the curves. The error
/// is the largest budget's of one of them: that which most engines reach between two budgets; among those the one at
/// which the order of most pairs is known, then the least. Where an engine has budgets of several kinds, its fastest
/// counts. Times are those of time_to_target (convergence.h): interpolated, or a bound. A bound has a rank only where
/// it settles who is faster: "at most 3 s" is not faster than 2 s, nor slower.
std::vector<RaceRecord> races_of(const std::vector<Convergence>& curves);

}  // namespace photonproof::inline harness_conclusions
