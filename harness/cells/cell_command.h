// The command line that renders a cell.
#pragma once

#include <atomic>
#include <filesystem>
#include <string>
#include <vector>

#include "harness/cells/run_cell.h"
#include "harness/suites/suite.h"

namespace photonproof::inline harness_cells {

class SceneCopies;

struct CellCommand {
  std::vector<std::string> argv;   ///< to be started
  std::vector<std::string> typed;  ///< to be repeated: with the scene's own path instead of the copy's
  /// The copy's folder, as argv says it, and the scene's own, for what the engine says of it.
  std::string given_folder, own_folder;
  std::string start_hint, argument_hint;  ///< engine_command.h
  std::filesystem::path image, stats;     ///< where the engine is told to write
  std::string layer{};                    ///< of the image which is the engine's picture
};

/// What run_cell is told; `crop` is that of the scene at its size in the suite.
CellRun cell_run(const Cell& cell, const CellCommand& command, const SuiteScene& scene,
                 const std::optional<FilmPart>& crop, const Limits& limits, const std::atomic<bool>* interrupt);

/// As a person would type it: paths from the current folder where that is shorter. `program` stands for {photonproof};
/// the image is "<stem>.<the engine's extension>" in `folder`. With `copies` the engine is given a copy of the
/// scene's folder (scene_copies.h), else the scene itself.
CellCommand cell_command(const SuiteCommon& suite, const Cell& cell, const std::filesystem::path& program,
                         const std::filesystem::path& folder, const std::string& stem, int threads,
                         SceneCopies* copies);

}  // namespace photonproof::inline harness_cells
