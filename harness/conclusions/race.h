// Race: which of a scene's engines is faster at equal error and more exact at equal time, and by how much.
#pragma once

#include <vector>

#include "reports/record/results.h"

namespace photonproof::inline harness_conclusions {

/// Records for each scene with two engines or more, in the order of the curves. An engine with several kinds of budget
/// counts with its best.
///
/// The error. One record for each target of the suite. Without targets, one record at a round error (1, 2 or 5 times a
/// power of ten), since an engine's own last error would favour that engine. The fastest engine's time to it must be a
/// value where possible. Among such errors, the one with the most known ratios; ties go to the least error, which is at
/// least 1e-6.
///
/// The time of `errors` is the largest round time that most engines' budgets enclose.
///
/// Ratios. A ratio of values has the interval exp(ln ratio +- hypot(h1, h2)). Here h1 and h2 are the half-widths of
/// both engines' intervals in logarithms (time_to_target, error_curve.h). A bound has a rank only where it settles its
/// order to the fastest engine with the confidence of its interval. "At most 3 s" is neither faster nor slower than
/// "2 s". The ratio of a bound is the least that the intervals allow. Errors of an engine that grow with the budget
/// (known_points) are left out.
std::vector<RaceRecord> races_of(const std::vector<Convergence>& curves);

}  // namespace photonproof::inline harness_conclusions
