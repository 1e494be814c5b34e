// Asks an engine for its version.
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
  /// What its cells have come to then: unsupported where the version command ends with unsupported_exit_code (a program
  /// that need not be installed), not_started where it cannot be started at all, else what it did.
  Status cells_end_as = Status::unsupported;
};

/// `suite_folder` and `program` (this one) stand for {suite} and {photonproof} in its commands, which have 20 s at
/// most.
EngineVersion ask_version(const Engine& engine, const std::filesystem::path& suite_folder,
                          const std::filesystem::path& program, double most_seconds = 20);

}  // namespace photonproof::inline harness_images
