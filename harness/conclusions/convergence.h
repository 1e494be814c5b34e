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

}  // namespace photonproof::inline harness_conclusions
