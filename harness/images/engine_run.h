// One run of an engine: fills in its command, starts it within limits, and returns the result.
#pragma once

#include <atomic>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "harness/cells/scene_copies.h"
#include "harness/images/executor.h"
#include "harness/suites/suite.h"
#include "reports/record/results.h"
#include "scenes/description/film_part.h"

namespace photonproof::inline harness_images {

/// An engine as used in a run.
struct ImageEngine {
  const Engine* row = nullptr;
  std::string version{};               ///< in its own words (engine_version.h)
  std::vector<std::string> further{};  ///< arguments after the row's own
  std::string fault{};                 ///< planted in the program, which is photonproof-faulty (scenes/base/faults.h)
};

/// A scene as used in a run.
struct ImageScene {
  const SuiteScene* row = nullptr;  ///< its size is that of the whole film, in pixels
  std::string content{};            ///< its hash (scenes/description/scene_hash.h)
  std::optional<FilmPart> crop{};   ///< the part of the film that is rendered, at the row's size; empty: all of it
  SceneCopies* copies = nullptr;    ///< engines are given these; null: the scene itself
};

struct EngineRun {
  ImageEngine engine;
  ImageScene scene;
  Budget budget;
  std::uint64_t seed = 0;
  Limits limits{};                       ///< with a number of threads
  std::filesystem::path program{};       ///< {photonproof}
  std::filesystem::path suite_folder{};  ///< {suite}
  std::filesystem::path results_folder{};
  std::string folder{};  ///< exists in the results folder; receives image, stats.json, stdout.txt and stderr.txt
  const std::atomic<bool>* interrupt = nullptr;
  std::optional<int> processor{};  ///< all of its processes run on this processor alone
  bool samples_peak = true;        ///< ProcessOptions::samples_peak
  const Executor* executor = &usual_executor();

  std::filesystem::path place() const { return results_folder / folder; }
  std::filesystem::path image() const;  ///< the path that the engine writes to
};

/// The exit code of an engine that cannot render this scene; the last line on standard error gives the reason.
inline constexpr int unsupported_exit_code = 3;

/// The file in the folder where an engine may write its stats (harness/suites/engine_stats.h).
inline constexpr const char* stats_name = "stats.json";

/// Whether the engine ended with that exit code and without a result, as the detail says.
bool exited_with(const Result& result, int exit_code);

/// A result without key and metrics; empty when the interrupt ended it. Its image path is relative to the results
/// folder, and empty where there is none. Its command has the scene's own path instead of the copy's, ready to be
/// typed. Its status is `unsupported` with unsupported_exit_code, `timeout` past the wall limit, `crash` past the
/// memory limit or after a signal or another exit code. It is `not_started` where the system cannot start the program,
/// and `bad_image` when the image is missing, unreadable, of another size or not finite everywhere. Throws InputError
/// where the scene cannot be copied.
///
/// The kept file stores the crop, or the whole film without one; a file with another part of the film is replaced. An
/// image of the crop's size counts as the crop.
std::optional<Result> run_engine(const EngineRun& run);

}  // namespace photonproof::inline harness_images
