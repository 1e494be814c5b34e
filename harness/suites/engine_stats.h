// The stats JSON that an engine may write at {stats} about its own run. Other keys are ignored:
//   {"schema_version": 1, "phases": {"render": 1.5}, "counts": {"rays": 1e9},
//    "skipped": ["caustic photon map: no specular surface"],
//    "losses": ["radiosity ends after 12 bounces: ..."], "cannot_find": ["caustics of lights without size"],
//    "denoised": {"library": "Open Image Denoise", "version": "2.5.1", "biased": true}}
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
  std::vector<std::string> losses;       ///< known errors of this image, as declared by the engine
  /// The losses that no number of samples removes: light that the engine cannot find, and the engines that can.
  std::vector<std::string> cannot_find;
  std::optional<std::string> denoised{};  ///< the library that filtered the image, with its version
  std::optional<std::string> problem;     ///< why (part of) the file could not be used, one sentence
};

/// Never throws because of the file's content: another program's statistics must not stop a run. A missing file gives
/// empty stats without a problem. Numbers that are not finite and negative phases are left out and named.
EngineStats read_engine_stats(const std::filesystem::path& file);

}  // namespace photonproof::inline harness_suites
