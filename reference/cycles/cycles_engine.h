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
  /// In the scene's radiance. With two batches or more its variance is the spread of their means;
  /// photonproof:batches among its metadata is their number.
  Rendering rendering;
  std::string version;                 ///< "Blender 3.4.1"
  std::string command;                 ///< as typed in a shell
  double relative_standard_error = 0;  ///< of the image's mean over all channels; 0 from one batch
  double wall_seconds = 0;
  double cpu_seconds = 0;
  std::uint64_t peak_bytes = 0;
  std::vector<std::string> defects;  ///< of the image: non-finite values
};

/// Throws InputError when Blender is not installed, EngineFailure when it does not finish with readable images of the
/// requested size. The temporary folder is removed in every case.
CyclesRun render_cycles(const CyclesExport& scene, const CyclesRunOptions& options = {});

/// The line of Blender's output that reports an error: a Python exception's or Blender's own. Empty where there is
/// none.
std::string blender_error(const std::string& console);

}  // namespace photonproof::inline reference_cycles
