// Climbs the sweeps, several renders side by side, and keeps every level that is decided.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "harness/suites/engines.h"
#include "reports/stress/stress_record.h"

namespace photonproof::inline harness_stress {

struct StressOptions {
  std::filesystem::path folder;      ///< receives everything; what an earlier run decided there counts
  std::filesystem::path program;     ///< this one, or one with a fault
  bool is_other_program = false;     ///< another build, which may not know a feature: what it refuses is left out
  std::vector<std::string> only;     ///< sweeps whose name contains one of these; empty: all
  std::vector<std::string> engines;  ///< these alone; empty: all that a sweep names
  std::vector<Engine> others{};      ///< engines that are no integrators, which `engines` may name
  bool turned = false;               ///< every sweep's scenes, so that no face lies along an axis
  bool quick = false;                ///< the heights that are wanted, by path and photonmapper
  int jobs = 0;                      ///< renders at a time; 0: one a core
  std::string command, version;      ///< for the record
  const std::atomic<bool>* interrupt = nullptr;
  std::function<void(std::size_t ended, std::size_t all, const StressSweep&)> ended{};  ///< one call at a time
};

/// The names of the sweeps that --only chooses from.
std::vector<std::string> stress_sweep_names(const std::filesystem::path& scratch);

/// Throws InputError where nothing is chosen, or the folder cannot be used. What renders do is part of the record.
/// `stress.json` is written; one of another program is kept beside it under its checksum.
StressRecord run_stress(const StressOptions& options);

}  // namespace photonproof::inline harness_stress
