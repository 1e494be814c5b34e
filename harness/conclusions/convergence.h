// Error against time from a run's finished cells.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "reports/record/results.h"
#include "scenes/images/image.h"

namespace photonproof::inline harness_conclusions {

/// The verdict on the images of one budget; `like` is one of its cells.
using JudgeImages = std::function<CorrectnessRecord(const Cell& like, std::span<const Image> images)>;

/// Key of CurvePoint::undefined where an error is as much the reference's, or that of rounding: then nothing follows
/// from it.
inline constexpr const char* own_error_key = "own_error";

/// Key of CurvePoint::undefined that says why relmse has no interval.
inline constexpr const char* interval_key = "relmse_interval";

using ErrorTargets = std::map<std::string, std::vector<double>>;  ///< by scene

/// One record for each scene, engine and kind of budget that has a finished cell (references are left out), in the
/// order of the results. Images are read from `folder`, where results.json lies; where one cannot be, the point keeps
/// what the record itself tells. Without `judge` there are no verdicts.
std::vector<Convergence> convergence_of(const Results& results, const std::filesystem::path& folder,
                                        const ErrorTargets& target_relmse, const JudgeImages& judge = {},
                                        Clock clock = Clock::wall);

/// Slope, efficiency and time to target of a record whose points are complete, or why they are not there, and the
/// caveats that go with them.
void conclude(Convergence& curve);

/// Of a finished cell with a reference; else empty.
std::optional<double> relmse_of(const Result& result);

/// The points of a curve that say how its error falls: each has a time and an error of its own, and no larger budget
/// has more than twice the error. A small budget that met none of the rare bright samples looks better than it is.
/// So points up to the last such leap are left out, and a single point behind it is, too.
struct KnownPoints {
  std::vector<const CurvePoint*> points;  ///< ascending budgets
  std::string leap;  ///< "error grows from 0.006 at spp=16 to 1.25 at spp=64"; empty where it does not
};
KnownPoints known_points(const Convergence& curve);

/// When the curve comes down to `relmse` and stays there, or why that is not known.
TargetTime time_to_target(const KnownPoints& curve, double relmse);

using CurvePoints = std::vector<std::pair<double, double>>;  ///< seconds and error

/// When the curve through `points` (seconds and error, ascending seconds) comes down to `target` for the last time:
/// log-log between two points. Empty where the first point is below already, or the last one still above.
std::optional<double> time_to_error(const CurvePoints& points, double target);

}  // namespace photonproof::inline harness_conclusions
