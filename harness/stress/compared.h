// Compares the output of `photonproof compare` for two files with known metrics.
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
  std::optional<double> value;  ///< Empty: the metric has no value, and the program gives the reason.
  double tolerance = 1e-5;      ///< Relative.
  bool is_limit = false;        ///< `value` is an upper bound.
};

/// The metrics that the program prints for two files, for comparison with others that must have the same metrics.
std::vector<KnownMetric> printed_metrics(const StressRunner& runner, const std::filesystem::path& reference,
                                         const std::filesystem::path& test, const std::vector<std::string>& names);

/// Refused where the program ends with an error and gives the reason.
LevelVerdict compare_files(const StressRunner& runner, const std::filesystem::path& reference,
                           const std::filesystem::path& test, const std::vector<KnownMetric>& known,
                           const std::vector<std::string>& arguments = {});

}  // namespace photonproof::inline harness_stress
