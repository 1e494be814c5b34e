// Is this program slower or more wrong than an older one? Times of two sessions differ by more than what is looked for,
// whatever is done about it, so the old program is run again, next to the new one (paired_rounds.h). Where it is not
// named, only the stored numbers are left (stored_changes.h), and they decide little. A record is data and may come
// from elsewhere: the program that it names is shown and never run.
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
  double seconds = 120;               ///< of one comparison, at most
  std::size_t most_rounds = 40;
  ChangeThresholds thresholds = {};
};

/// The run that is compared.
struct AgainstRun {
  const Suite& suite;
  const Results& now;  ///< holds the references' images
  std::filesystem::path program;
  std::filesystem::path folder;  ///< where results.json of `now` lies; rounds are rendered in a folder below it
  std::string only;              ///< as BenchOptions
  const std::atomic<bool>* interrupt = nullptr;
  std::function<void(const ChangeRecord&)> heard;  ///< of each change as it is known; may be empty
  /// How the run draws a cell in a folder below its own.
  std::function<EngineRun(const Cell&, const std::string& folder)> run_of;
};

/// For every scene and engine of both runs, at the largest of each kind of budget: a record of the processor time (but
/// not where seconds are the budget) and one of relmse, where the scene has a reference. In rounds every image has a
/// seed of its own, from the cell's seed up. Ends early, with what is known, when interrupted.
std::vector<ChangeRecord> changes_against(const AgainstRun& run, const Results& old_run, const AgainstOptions& options);

/// The older run; to be read before this one is written, which may be to the same file. Throws InputError when it, or
/// the old program, cannot be read.
Results read_old_run(const AgainstOptions& options);

/// The build that a record is of: a hash of its file. Empty when it cannot be read.
std::string program_hash(const std::filesystem::path& program);

/// Under which names Results::versions records the program that {photonproof} stood for.
inline constexpr const char* program_key = "program";
inline constexpr const char* program_hash_key = "program_hash";

}  // namespace photonproof::inline harness_bench
