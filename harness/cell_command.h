// The command line that renders a cell.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/suite.h"

namespace photonproof {

struct CellCommand {
  std::vector<std::string> argv;
  std::filesystem::path image, stats;  ///< where the engine is told to write
};

/// As a person would type it: paths from the current folder where that is shorter. `program` stands for {photonproof};
/// the image is "<stem>.<the engine's extension>" in `folder`.
CellCommand cell_command(const SuiteCommon& suite, const Cell& cell, const std::filesystem::path& program,
                         const std::filesystem::path& folder, const std::string& stem, int threads);

}  // namespace photonproof
