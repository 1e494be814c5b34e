// Who is faster at equal error: a scene's engines compared at the least error that all of them reach.
#pragma once

#include <vector>

#include "reports/record/results.h"

namespace photonproof {

/// One record for each scene on which two engines or more have an error and a time, in the order of the curves. Where
/// an engine has budgets of several kinds, its fastest counts. Times are interpolated between budgets (time_to_error),
/// never beyond them. Points whose error is not their own (own_error_key) do not count, nor do engines whose error
/// grows with the budget: they met rare bright samples too seldom for it to be known.
std::vector<RaceRecord> races_of(const std::vector<Convergence>& curves);

}  // namespace photonproof
