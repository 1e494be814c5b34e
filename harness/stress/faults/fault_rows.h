// The faults, a row each: the disturbance, the property that must hold, and the number of trials.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "harness/stress/faults/trial.h"

namespace photonproof::inline harness_stress_faults {

struct FaultRow {
  std::string name;          ///< "kill".
  std::string done;          ///< The disturbance.
  std::string must_hold;     ///< The property that must hold.
  int quick = 1, full = 10;  ///< Trials a work.
  bool is_kill = false;      ///< Runs as many trials as the requested kills take.
  std::function<TrialResult(const Trial&)> run;
};

/// All faults, in the order of the trials.
const std::vector<FaultRow>& fault_rows();

// A file each. They throw NotTried, and InputError where the machine itself fails.
TrialResult kill_trial(const Trial& trial);
TrialResult full_disk_trial(const Trial& trial);
TrialResult read_only_disk_trial(const Trial& trial);
TrialResult vanishing_disk_trial(const Trial& trial);
TrialResult slow_disk_trial(const Trial& trial);
TrialResult failing_disk_trial(const Trial& trial);
TrialResult two_runs_trial(const Trial& trial);
TrialResult clock_jumps_trial(const Trial& trial);
TrialResult little_memory_trial(const Trial& trial);

}  // namespace photonproof::inline harness_stress_faults
