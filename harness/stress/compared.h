// What `photonproof compare` says of two files, held against what it has to say.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "harness/stress/level_judge.h"
#include "harness/stress/level_run.h"

namespace photonproof::inline harness_stress {

struct KnownMetric {
  std::string name;
  std::optional<double> value;  ///< empty: has none, and the program says why
  double tolerance = 1e-5;      ///< relative
  bool is_limit = false;        ///< `value` is the most it may be
};

/// What the program itself says of two files, to be held against others that have the same metrics.
std::vector<KnownMetric> metrics_said_of(const StressRunner& runner, const std::filesystem::path& reference,
                                         const std::filesystem::path& test, const std::vector<std::string>& names);

/// Refused where the program ends with an error that it explains.
LevelVerdict compare_files(const StressRunner& runner, const std::filesystem::path& reference,
                           const std::filesystem::path& test, const std::vector<KnownMetric>& known,
                           const std::vector<std::string>& arguments = {});

}  // namespace photonproof::inline harness_stress
