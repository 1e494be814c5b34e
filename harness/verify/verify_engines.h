// The engines that verify a scene: rows of engines.toml and of a suite, and how independent they are.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "harness/images/engine_version.h"
#include "harness/suites/engines.h"
#include "scenes/description/description.h"

namespace photonproof::inline harness_verify {

struct VerifyEngine {
  Engine row;
  std::string sampling;     ///< the code that finds its light paths: engines with the same one share mistakes
  std::string budget_kind;  ///< "spp", "quality" ...
  bool is_ours = false;     ///< an integrator of this program, which shares materials, lights and textures
  EngineVersion version;    ///< with the problem if it is not installed
  bool counts_samples() const { return budget_kind == "spp"; }
};

struct EngineChoice {
  std::filesystem::path rows;      ///< a TOML file with more [[engine]] rows; empty: none
  std::vector<std::string> names;  ///< only these; empty: all that verify
  std::filesystem::path program;   ///< replaces {photonproof}
};

/// Engines that are exact or declare their error: path, bdpt, ptracer, volpath, photonmapper, povray, cycles, mitsuba,
/// and every row of the file. Runs their version commands. Throws InputError for a file that cannot be read and a name
/// without a row.
std::vector<VerifyEngine> verify_engines(const EngineChoice& choice);

/// The reason why pictures by this sampling lack some of the scene's light with any number of samples; empty if they
/// show it all. Light paths never reach the eye by mirrors, clear glass, clear coats or holes that it looks at. Nor do
/// they from the far parts of an endless plane under a sky.
std::string what_is_not_shown(const std::string& sampling, const SceneDescription& scene);

}  // namespace photonproof::inline harness_verify
