// Renders batches of one scene until their mean has the requested standard error. A batch is an image of an ImageSource
// (harness/images/image_source.h), removed once the mean has it. A stopped batch continues from its checkpoint.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "harness/statistics/batch_means.h"
#include "harness/suites/suite.h"
#include "scenes/description/film_part.h"

namespace photonproof::inline harness_references {

struct ReferenceRun {
  std::filesystem::path program;       ///< the renderer
  SuiteScene scene;                    ///< its file, and the size of the film
  std::string content;                 ///< the scene's hash
  std::optional<FilmPart> crop;        ///< the rendered part; empty: the whole film
  std::vector<std::string> arguments;  ///< for reading the scene
  std::string integrator;
  double standard_error = 0;      ///< to reach (relative_standard_error)
  std::optional<double> seconds;  ///< wall time after which the batch at work is stopped
  int threads = 0;
  std::filesystem::path folder;  ///< exists; used for this scene, size, integrator and program alone
  const std::atomic<bool>* interrupt = nullptr;
  /// Called after every batch with the batches so far and their standard error (from two on).
  std::function<void(const BatchMeans&, std::optional<double> standard_error)> progress;
};

/// Least number of batches. With B batches a pixel's variance is itself uncertain by sqrt(2/(B - 1)), a quarter with
/// 32.
inline constexpr int least_batches = 32;

struct ReferenceProgress {
  BatchMeans means;
  std::optional<double> standard_error;  ///< from two batches on
  enum class End { reached, out_of_time, interrupted } end = End::reached;
};

/// The samples per batch come from a few small trial batches, which are thrown away, and then stay fixed. They depend
/// on the scene and the standard error first asked for, never on the machine. Throws InputError with the renderer's own
/// message when it fails.
ReferenceProgress run_reference(const ReferenceRun& run);

/// Seed of a batch's random numbers. It is far from the small numbers that people and suites choose, so no image
/// compared with the reference shares a sample with it.
std::uint64_t batch_seed(int batch);

}  // namespace photonproof::inline harness_references
