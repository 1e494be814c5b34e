// The faults, a row each: what is done, what must hold, and how often it is tried.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "harness/stress/faults/trial.h"

namespace photonproof::inline harness_stress_faults {

struct FaultRow {
  std::string name;          ///< "kill"
  std::string done;          ///< what is done
  std::string must_hold;     ///< what must hold
  int quick = 1, full = 10;  ///< trials a work
  bool is_kill = false;      ///< as many trials as it takes for the kills that are asked for
  std::function<TrialResult(const Trial&)> run;
};

/// In the order in which they are tried.
const std::vector<FaultRow>& fault_rows();

// A file each; they throw NotTried, and InputError where the machine fails them.
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
