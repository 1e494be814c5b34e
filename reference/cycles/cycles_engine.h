// Runs Blender on an exported scene, in a process and a temporary folder of its own.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "reference/cycles/cycles_export.h"
#include "reference/engines/engine_run.h"
#include "scenes/images/image.h"

namespace photonproof::inline reference_cycles {

struct CyclesRunOptions {
  std::optional<double> wall_limit_seconds{};
  std::optional<std::uint64_t> memory_limit_bytes{};
  const std::atomic<bool>* interrupt = nullptr;
  /// Share of samples done and what is being done; called from the calling thread.
  std::function<void(double, const std::string&)> progress{};
  std::string program = "blender";
};

struct CyclesRun {
  /// In the scene's radiance. Its variance, where there are two batches or more, is what their spread says of the mean;
  /// photonproof:batches among its metadata says how many they are.
  Rendering rendering;
  std::string version;                 ///< "Blender 3.4.1"
  std::string command;                 ///< as one would type it
  double relative_standard_error = 0;  ///< of the image's mean, all channels; 0 from one batch
  double wall_seconds = 0;
  double cpu_seconds = 0;
  std::uint64_t peak_bytes = 0;
  std::vector<std::string> defects;  ///< of the image: values that are not finite
};

/// Throws InputError when Blender is not installed, EngineFailure when it does not finish with readable images of the
/// size that was asked for. The temporary folder is gone in every case.
CyclesRun render_cycles(const CyclesExport& scene, const CyclesRunOptions& options = {});

/// The line by which Blender's output says what went wrong: that of a Python exception or an error of Blender's; empty
/// where there is none.
std::string blender_error(const std::string& console);

}  // namespace photonproof::inline reference_cycles
