// One run of an engine: fills its command, starts it within limits, and says what came of it.
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

/// An engine as a run uses it.
struct ImageEngine {
  const Engine* row = nullptr;
  std::string version{};               ///< in its own words (engine_version.h)
  std::vector<std::string> further{};  ///< arguments after the row's own
  std::string fault{};                 ///< planted in the program, which is photonproof-faulty (scenes/base/faults.h)
};

/// A scene as a run uses it.
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
  std::string folder{};  ///< in the results folder; exists; receives image, stats.json, stdout.txt and stderr.txt
  const std::atomic<bool>* interrupt = nullptr;
  std::optional<int> processor{};  ///< all of its processes run on this one alone
  const Executor* executor = &usual_executor();

  std::filesystem::path place() const { return results_folder / folder; }
  std::filesystem::path image() const;  ///< where the engine is told to write
};

/// The exit code by which an engine says that it cannot render this scene; the last line on standard error says why.
inline constexpr int unsupported_exit_code = 3;

/// The file in the folder where an engine may write its stats (harness/suites/engine_stats.h).
inline constexpr const char* stats_name = "stats.json";

/// A result without key and metrics; empty when the interrupt ended it. Its image is relative to the results folder,
/// empty where there is none. Its command is as a person would type it, with the scene's own path instead of the
/// copy's. Its status is `timeout` past the wall limit; `crash` past the memory limit, by a signal or an exit code;
/// `not_started` where the system cannot start the program; `bad_image` when the image is missing, unreadable, of
/// another size or not finite everywhere. Throws InputError where the scene cannot be copied.
///
/// The kept file stores the crop, or the whole film without one. A file that stores another part of the film is
/// replaced. An image of the crop's size counts as the crop.
std::optional<Result> run_engine(const EngineRun& run);

}  // namespace photonproof::inline harness_images
