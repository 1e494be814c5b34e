// Runs Mitsuba on an exported scene, in a process and a temporary folder of its own.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "reference/engines/engine_run.h"
#include "reference/mitsuba/mitsuba_export.h"
#include "scenes/images/image.h"

namespace photonproof::inline reference_mitsuba {

struct MitsubaRunOptions {
  std::string python;  ///< the interpreter, of find_mitsuba_python
  std::optional<double> wall_limit_seconds{};
  std::optional<std::uint64_t> memory_limit_bytes{};
  const std::atomic<bool>* interrupt = nullptr;
  /// Share of samples done and what is being done; called from the calling thread.
  std::function<void(double, const std::string&)> progress{};
};

struct MitsubaRun {
  /// In the scene's radiance. With two batches or more its variance is the spread of their means;
  /// photonproof:batches among its metadata is their number.
  Rendering rendering;
  std::string version;  ///< "Mitsuba 3.9.1"
  std::string variant;  ///< "llvm_ad_rgb"
  std::string command;  ///< as typed in a shell
  /// Parts of the script's time: starting Mitsuba, reading the scene, compiling kernels, rendering.
  double import_seconds = 0, load_seconds = 0, compile_seconds = 0, render_seconds = 0;
  double relative_standard_error = 0;  ///< of the image's mean over all channels; 0 from one batch
  double wall_seconds = 0;
  double cpu_seconds = 0;
  std::uint64_t peak_bytes = 0;
  std::vector<std::string> defects;  ///< of the image: non-finite values
};

/// Throws InputError when the interpreter cannot be started, EngineFailure when it does not finish with readable images
/// of the requested size. The temporary folder is removed in every case.
MitsubaRun render_mitsuba(const MitsubaExport& scene, const MitsubaRunOptions& options);

}  // namespace photonproof::inline reference_mitsuba
