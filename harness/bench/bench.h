// Runs a suite. Every cell is a process of its own, and finished cells are kept by content. While engines run, only
// their costs are recorded; images are compared and conclusions drawn after the last engine has ended.
#pragma once

#include <atomic>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "harness/bench/against.h"
#include "harness/suites/suite.h"

namespace photonproof::inline harness_bench {

struct BenchOptions {
  std::filesystem::path results_folder;         ///< made when it is missing
  std::filesystem::path program;                ///< this program, for {photonproof}
  std::string command;                          ///< repeats the run; for the record
  std::map<std::string, std::string> versions;  ///< of libraries, for the record
  std::string comparison_version;               ///< changes whenever metrics or pictures may change
  bool fresh = false;                           ///< measure finished cells again, beside their old results
  bool retry = false;                           ///< measure timed-out, crashed and bad-image cells again
  std::optional<AgainstOptions> against;        ///< an older run to compare with
  std::string only;                             ///< run only cells whose label contains it, and their references
  const std::atomic<bool>* interrupt = nullptr;
};

/// Called as the cells run; `number` counts from 1 to `total`.
class BenchObserver {
 public:
  virtual ~BenchObserver() = default;
  virtual void starts(std::size_t number, std::size_t total, const Cell& cell) = 0;
  virtual void ended(std::size_t number, std::size_t total, const Result& result) = 0;
  virtual void changed(const ChangeRecord&) {}  ///< one answer of the comparison with an older run
};

struct BenchSummary {
  std::filesystem::path results_file;
  std::size_t measured = 0;  ///< cells that ran now
  std::size_t kept = 0;      ///< whose result existed already
  std::size_t missing = 0;   ///< without a result: interrupted, or not among `only`
  std::map<Status, std::size_t> by_status;
  std::map<Change, std::size_t> by_change;  ///< against the older run
  double seconds = 0;                       ///< of the whole run, without the comparison with an older run
  double engine_seconds = 0;                ///< the part of them while an engine ran
  double harness_cpu_seconds = 0;           ///< processor time of this program itself
  bool interrupted = false;
};

/// Throws InputError when the suite's scenes or their expect.toml cannot be read, or another run holds the folder. A
/// failure of an engine is a result, never an error.
BenchSummary run_bench(const Suite& suite, const BenchOptions& options, BenchObserver& observer);

}  // namespace photonproof::inline harness_bench
