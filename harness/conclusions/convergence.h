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

namespace photonproof {

/// The verdict on the images of one budget; `like` is one of its cells.
using JudgeImages = std::function<CorrectnessRecord(const Cell& like, std::span<const Image> images)>;

/// Key of CurvePoint::undefined where an error is as much the reference's, or that of rounding: then nothing follows
/// from it.
inline constexpr const char* own_error_key = "own_error";

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

using CurvePoints = std::vector<std::pair<double, double>>;  ///< seconds and error

/// When the curve through `points` (seconds and error, ascending seconds) first comes down to `target`: log-log between
/// two points; empty outside of them.
std::optional<double> time_to_error(const CurvePoints& points, double target);

}  // namespace photonproof
