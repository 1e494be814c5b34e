// Tries every fault on every work, and keeps the results.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "harness/stress/faults/faults_record.h"

namespace photonproof::inline harness_stress_faults {

struct FaultsOptions {
  std::filesystem::path folder;   ///< Receives everything; decisions of an earlier run of the same program count.
  std::filesystem::path program;  ///< The program photonproof.
  int kills = 1000;               ///< For all works together.
  bool quick = false;             ///< One trial a work; `kills` still holds.
  std::string only;               ///< Pairs of fault and work whose name contains this; empty: all.
  std::uint64_t seed = 1;         ///< Decides every moment.
  std::string command, version;   ///< For the record.
  const std::atomic<bool>* interrupt = nullptr;
  /// Called after each trial with the number of faults so far and of all.
  std::function<void(int done, int all, const FaultOutcome&)> progress{};
};

/// "kill, bench": the names that --only chooses from.
std::vector<std::string> fault_names();

/// Throws InputError where nothing is chosen, the folder cannot be used, or two undisturbed runs of a work differ.
/// Writes faults.json after every trial.
FaultsRecord run_faults(const FaultsOptions& options);

}  // namespace photonproof::inline harness_stress_faults
