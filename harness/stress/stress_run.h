// Runs the sweeps, several renders side by side, and keeps every decided level.
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
  std::filesystem::path folder;      ///< Receives everything; levels decided there by an earlier run count.
  std::filesystem::path program;     ///< This program, or one with a fault.
  bool is_other_program = false;     ///< Another build, which may lack a feature: scenes it refuses are left out.
  std::vector<std::string> only;     ///< Sweeps whose name contains one of these; empty: all.
  std::vector<std::string> engines;  ///< The engines to run; empty: all that a sweep names.
  std::vector<Engine> others{};      ///< Engines that are not integrators, which `engines` may name.
  bool turned = false;               ///< Turns every sweep's scenes, so that no face lies along an axis.
  bool quick = false;                ///< The wanted levels only, by path and photonmapper.
  int jobs = 0;                      ///< Renders at a time; 0: one a core.
  std::string command, version;      ///< For the record.
  const std::atomic<bool>* interrupt = nullptr;
  std::function<void(std::size_t ended, std::size_t all, const StressSweep&)> ended{};  ///< One call at a time.
};

/// The names of the sweeps that --only chooses from.
std::vector<std::string> stress_sweep_names(const std::filesystem::path& scratch);

/// Throws InputError where nothing is chosen, or the folder cannot be used. Failing renders are part of the record.
/// Writes `stress.json`, and keeps one of another program beside it under its checksum.
StressRecord run_stress(const StressOptions& options);

}  // namespace photonproof::inline harness_stress
