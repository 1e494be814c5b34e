// Runs an engine's version command.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "harness/suites/engines.h"
#include "reports/record/results.h"

namespace photonproof::inline harness_images {

struct EngineVersion {
  std::string line;                    ///< what its version commands print, joined by " + "
  std::optional<std::string> problem;  ///< why the engine cannot be used
  /// Status of its cells in that case: `unsupported` if the version command ends with unsupported_exit_code, since the
  /// program need not be installed. It is `not_started` if the command cannot start, else the command's own failure.
  Status cells_end_as = Status::unsupported;
};

/// `suite_folder` and `program` (this program) replace {suite} and {photonproof} in its commands. Each command has at
/// most 20 s.
EngineVersion ask_version(const Engine& engine, const std::filesystem::path& suite_folder,
                          const std::filesystem::path& program, double most_seconds = 20);

}  // namespace photonproof::inline harness_images
