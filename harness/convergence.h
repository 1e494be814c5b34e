// Error against time from a run's finished cells.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "harness/results.h"

namespace photonproof {

/// One record for each scene, engine and kind of budget that has a finished cell (references are left out), in the
/// order of the results. Images are read from `folder`, where results.json lies; where one cannot be, the point keeps
/// what the record itself tells. `target_relmse` by scene.
std::vector<Convergence> convergence_of(const Results& results, const std::filesystem::path& folder,
                                        const std::map<std::string, double>& target_relmse);

/// Slope, efficiency and time to target of a record whose points are complete, and the caveats that go with them.
void conclude(Convergence& curve);

/// When the curve through `points` (seconds and error, ascending seconds) first comes down to `target`: log-log between
/// two points; empty outside of them.
std::optional<double> time_to_error(const std::vector<std::pair<double, double>>& points, double target);

}  // namespace photonproof
