// What an engine says about its own run: the stats JSON it may write at {stats}. Keys that are not below are ignored:
//   {"schema_version": 1, "phases": {"render": 1.5}, "counts": {"rays": 1e9},
//    "skipped": ["caustic photon map: no specular surface"], "losses": ["radiosity ends after 12 bounces: ..."],
//    "cannot_find": ["caustics of lights without size"]}
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace photonproof::inline harness_suites {

struct EngineStats {
  std::map<std::string, double> phases;  ///< seconds by phase
  std::map<std::string, double> counts;  ///< rays, photons ...
  std::vector<std::string> skipped;      ///< "pass: reason"
  std::vector<std::string> losses;       ///< known errors of this image, as the engine declares them
  /// Those of the losses that no number of samples cures: light that the engine cannot find, and who can.
  std::vector<std::string> cannot_find;
  std::optional<std::string> problem;  ///< why (part of) the file could not be used, one sentence
};

/// Never throws for what an engine wrote: another program's statistics must not stop a run. A missing file is empty
/// stats without a problem. Numbers that are not finite and phases that are negative are left out and named.
EngineStats read_engine_stats(const std::filesystem::path& file);

}  // namespace photonproof::inline harness_suites
