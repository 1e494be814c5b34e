// Asks an engine for its version.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "harness/engines.h"

namespace photonproof {

struct EngineVersion {
  std::string line;                    ///< what its version commands print, joined by " + "
  std::optional<std::string> problem;  ///< why the engine cannot be used
};

/// `suite_folder` and `program` (this one) stand for {suite} and {photonproof} in its commands.
EngineVersion ask_version(const Engine& engine, const std::filesystem::path& suite_folder,
                          const std::filesystem::path& program);

}  // namespace photonproof
