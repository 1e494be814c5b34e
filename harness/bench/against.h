// Is this program slower or less accurate than an older one? Times of two sessions differ by more than the change to be
// found, so the old program runs again next to the new one (paired_rounds.h). Without the old program only the stored
// numbers are compared (stored_changes.h), and they rarely decide. A record is data and may come from elsewhere: the
// program that it names is shown and never run.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "harness/conclusions/paired_rounds.h"
#include "harness/images/engine_run.h"
#include "harness/suites/suite.h"
#include "reports/record/results.h"

namespace photonproof::inline harness_bench {

inline constexpr const char* against_folder = "cells/against";  ///< in the results folder, while programs are compared

struct AgainstOptions {
  std::filesystem::path results;      ///< the older run's results.json
  std::filesystem::path old_program;  ///< empty: stored numbers are compared, nothing is run
  double seconds = 120;               ///< for one comparison, at most
  std::size_t most_rounds = 40;
  ChangeThresholds thresholds = {};
};

/// The run that is compared.
struct AgainstRun {
  const Suite& suite;
  const Results& now;  ///< holds the references' images
  std::filesystem::path program;
  std::filesystem::path folder;  ///< where results.json of `now` lies; rounds are rendered in a folder below it
  std::string only;              ///< as in BenchOptions
  const std::atomic<bool>* interrupt = nullptr;
  std::function<void(const ChangeRecord&)> heard;  ///< called with each change as it is known; may be empty
  /// The engine run that renders a cell as this run does, in a folder below its own.
  std::function<EngineRun(const Cell&, const std::string& folder)> run_of;
};

/// Compares every scene and engine of both runs at the largest budget of each kind. Each gives a record of processor
/// time, unless seconds are the budget, and one of relmse, where the scene has a reference. In rounds every image has
/// its own seed, counted up from the cell's seed. An interrupt ends it early, with the records so far.
std::vector<ChangeRecord> changes_against(const AgainstRun& run, const Results& old_run, const AgainstOptions& options);

/// The older run. Must be called before this run is written, possibly to the same file. Throws InputError when the run
/// or the old program cannot be read.
Results read_old_run(const AgainstOptions& options);

/// Hash of the program's file, which identifies the build. Empty when the file cannot be read.
std::string program_hash(const std::filesystem::path& program);

/// Keys of Results::versions for the program that {photonproof} stood for.
inline constexpr const char* program_key = "program";
inline constexpr const char* program_hash_key = "program_hash";

}  // namespace photonproof::inline harness_bench
