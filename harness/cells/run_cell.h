// Measures one cell: starts the engine, waits within the limits, and says what came of it.
#pragma once

#include <atomic>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "harness/suites/suite.h"
#include "reports/record/results.h"
#include "scenes/description/film_part.h"

namespace photonproof::inline harness_cells {

struct CellRun {
  Cell cell;
  std::vector<std::string> argv;
  std::filesystem::path image;          ///< where the engine is told to write; does not exist yet
  std::filesystem::path stats;          ///< where it may write its stats JSON
  std::filesystem::path output_folder;  ///< receives stdout.txt and stderr.txt where the engine printed something
  int width = 0, height = 0;            ///< pixels of the whole film
  std::optional<FilmPart> crop{};       ///< the part of the film that is rendered; empty: all of it
  std::string layer{};                  ///< of the image which is the picture: all that is kept of it; empty: any
  Limits limits;
  const std::atomic<bool>* interrupt = nullptr;
  std::optional<int> processor{};    ///< all of its processes run on this one alone
  std::vector<std::string> typed{};  ///< how a person repeats it, where that is not `argv`
  /// What the engine calls `given` in its words is said as `own`: a copy of the scene's folder, and the folder itself.
  std::string given_folder{}, own_folder{};
  std::string start_hint{}, argument_hint{};  ///< ends of the sentence when it cannot be started, when it fails
};

/// The exit code by which an engine says that it cannot render this scene; the last line on standard error says why.
inline constexpr int unsupported_exit_code = 3;

/// A result without key, image path and metrics but with the image's checksum; empty when the interrupt ended it. Its
/// status is `timeout` past the wall limit; `crash` past the memory limit, by a signal or an exit code; `not_started`
/// where the system cannot start the program; `bad_image` when the image is missing, unreadable, of another size or not
/// finite everywhere.
///
/// The kept file stores the crop, or the whole film without one. A file that stores another part of the film is
/// replaced. An image of the crop's size counts as the crop.
std::optional<Result> run_cell(const CellRun& run);

}  // namespace photonproof::inline harness_cells
