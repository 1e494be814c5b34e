// Runs POV-Ray on an exported scene, in a process and a temporary folder of its own.
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>

#include "reference/engines/engine_run.h"
#include "reference/povray/povray_export.h"
#include "reference/povray/povray_statistics.h"
#include "scenes/images/image.h"

namespace photonproof::inline reference_povray {

struct PovrayRunOptions {
  std::optional<double> wall_limit_seconds{};
  std::optional<std::uint64_t> memory_limit_bytes{};
  const std::atomic<bool>* interrupt = nullptr;
  /// Share of pixels done and what is being done; called from the calling thread.
  std::function<void(double, const std::string&)> progress{};
  std::string program = "povray";
};

struct PovrayRun {
  /// In the scene's radiance. Images by paths whose sub-pixels no filter blurs have a variance, from the sub-pixels'
  /// spread (edges count as noise). Otherwise POV-Ray makes one deterministic estimate.
  Rendering rendering;
  std::string version;  ///< "POV-Ray 3.7.0.10.unofficial"
  std::string command;  ///< as typed in a shell
  PovrayStatistics statistics;
  double wall_seconds = 0;
  double cpu_seconds = 0;
  std::uint64_t peak_bytes = 0;
  std::vector<std::string> defects;  ///< of the image: non-finite values
};

/// Runs one thread, so that the same scene gives the same bits. Throws InputError when POV-Ray is not installed,
/// EngineFailure when it does not finish. The temporary folder is removed in every case.
PovrayRun render_povray(const PovrayExport& scene, const PovrayRunOptions& options = {});

/// The mean of each grid x grid block of pixels, times `gain`. Precondition: grid divides the size.
Image box_downsample(const Image& image, int grid, double gain);

/// The variance of that mean, from the spread within each block. Precondition: grid is at least 2.
Image variance_of_blocks(const Image& image, int grid, double gain);

}  // namespace photonproof::inline reference_povray
