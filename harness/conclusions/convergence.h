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

/// Key of ConvergencePoint::undefined where an error is the reference's as well, or rounding: then nothing follows from
/// it.
inline constexpr const char* own_error_key = "own_error";

/// Key of ConvergencePoint::undefined with the reason why relmse has no interval.
inline constexpr const char* interval_key = "relmse_interval";

using ErrorTargets = std::map<std::string, std::vector<double>>;  ///< by scene

/// One record for each scene, engine and kind of budget that has a finished cell, in the order of the results;
/// references are left out. Images are read from `folder`, where results.json lies. Where one cannot be read, the point
/// has only the record's own numbers. Without `judge` there are no verdicts.
std::vector<Convergence> convergence_of(const Results& results, const std::filesystem::path& folder,
                                        const ErrorTargets& target_relmse, const JudgeImages& judge = {},
                                        Clock clock = Clock::wall);

/// Slope, efficiency and time to target of a record whose points are complete, or the reasons why they are undefined,
/// with the warnings that belong to them.
void conclude(Convergence& curve);

/// relmse of a finished cell with a reference; else empty.
std::optional<double> relmse_of(const Result& result);

/// The points of a curve that show how its error falls. Each has a time and an error of its own, and no larger budget
/// has more than twice its error. A small budget that missed the rare bright samples looks better than it is. So points
/// before the last such leap are left out, and so is a point behind it if there is only one.
struct KnownPoints {
  std::vector<const ConvergencePoint*> points;  ///< ascending budgets
  std::string leap;  ///< "error grows from 0.006 at spp=16 to 1.25 at spp=64"; empty where it does not
};
KnownPoints known_points(const Convergence& curve);

/// The time at which the curve comes down to `relmse` and stays there, or the reason why it is not known.
TargetTime time_to_target(const KnownPoints& curve, double relmse);

using ConvergencePoints = std::vector<std::pair<double, double>>;  ///< seconds and error

/// The time at which the curve through `points` (seconds and error, ascending seconds) falls to `target` for the last
/// time, interpolated log-log between two points. Empty where the first point is below it already, or the last one
/// still above.
std::optional<double> time_to_error(const ConvergencePoints& points, double target);

}  // namespace photonproof::inline harness_conclusions
