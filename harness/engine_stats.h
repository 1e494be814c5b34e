// What an engine says about its own run: the stats JSON it may write at {stats}.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace photonproof {

struct EngineStats {
  std::map<std::string, double> phases;  ///< seconds by phase
  std::map<std::string, double> counts;  ///< rays, photons ...
  std::vector<std::string> skipped;      ///< "pass: reason"
  std::optional<std::string> problem;    ///< why (part of) the file could not be used, one sentence
};

/// Never throws for what an engine wrote: another program's statistics must not stop a run. A missing file is empty
/// stats without a problem. Numbers that are not finite and phases that are negative are left out and named.
EngineStats read_engine_stats(const std::filesystem::path& file);

}  // namespace photonproof
