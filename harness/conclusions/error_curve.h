// Error against time as a curve: straight lines in logarithms between measured budgets, never beyond them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "harness/statistics/statistics.h"
#include "reports/record/results.h"

namespace photonproof::inline harness_conclusions {

/// Key of ConvergencePoint::undefined where an error is the reference's as well, or rounding: then nothing follows from
/// it.
inline constexpr const char* own_error_key = "own_error";

inline constexpr const char* no_own_error = "no budget has an error of its own";

/// Whether the point's error and time are known, positive, and the engine's own.
bool has_own_error(const ConvergencePoint& point);

/// 95 % interval of the point's relmse. Where rare bright samples may be missing it is the spread over seeds.
std::optional<Interval> relmse_interval(const ConvergencePoint& point);

/// The points of a curve that show how its error falls. Each has a time and an error of its own, and no larger budget
/// has more than twice its error. A small budget that missed the rare bright samples looks better than it is. So points
/// before the last such leap are left out, and so is a point behind it if there is only one.
struct KnownPoints {
  std::vector<const ConvergencePoint*> points;  ///< ascending seconds
  std::string leap;  ///< "error grows from 0.006 at spp=16 to 1.25 at spp=64"; empty where it does not
};
KnownPoints known_points(const Convergence& curve);

/// Least squares of log relmse on log seconds; empty with fewer than two different times.
std::optional<LineFit> fit_in_logarithms(const KnownPoints& curve);

/// The time at which the curve comes down to `relmse` and stays there, or the reason why it is not known. It is
/// interpolated in logarithms. Half-widths of its interval, in logarithms: h^2 = h(seconds)^2 + (h(relmse) / slope)^2,
/// each h interpolated between both points, the slope fitted to all of them.
TargetTime time_to_target(const KnownPoints& curve, double relmse);

/// The error at a time, empty outside the measured times. Intervals as in time_to_target.
std::optional<Estimate> error_at_time(const KnownPoints& curve, double seconds);

}  // namespace photonproof::inline harness_conclusions
