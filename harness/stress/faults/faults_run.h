// Lets every fault befall every work, and keeps what is decided.
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
  std::filesystem::path folder;   ///< receives everything; what an earlier run of the same program decided counts
  std::filesystem::path program;  ///< photonproof
  int kills = 1000;               ///< of all works together
  bool quick = false;             ///< one trial a work; the kills are as asked
  std::string only;               ///< pairs of fault and work whose name contains this; empty: all
  std::uint64_t seed = 1;         ///< decides every moment
  std::string command, version;   ///< for the record
  const std::atomic<bool>* interrupt = nullptr;
  /// After each trial: what befell so far, of all.
  std::function<void(int done, int all, const FaultOutcome&)> progress{};
};

/// "kill, bench": the names that --only chooses from.
std::vector<std::string> fault_names();

/// Throws InputError where nothing is chosen, the folder cannot be used, or a work does not come to the same twice in
/// peace. faults.json is written after every trial.
FaultsRecord run_faults(const FaultsOptions& options);

}  // namespace photonproof::inline harness_stress_faults
