// The engines that verify a scene: rows of engines.toml and of a suite, with what their agreement proves.
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
  std::string sampling;     ///< whose code finds its light paths: engines of one share mistakes
  std::string budget_kind;  ///< "spp", "quality" ...
  bool is_ours = false;     ///< an integrator of this program: it shares materials, lights and textures with the others
  EngineVersion version;    ///< with the problem where it is not installed
  bool counts_samples() const { return budget_kind == "spp"; }
};

struct EngineChoice {
  std::filesystem::path rows;      ///< a TOML file whose [[engine]] rows come after ours; empty: none
  std::vector<std::string> names;  ///< these alone; empty: all that verify
  std::filesystem::path program;   ///< stands for {photonproof}
};

/// Those that are exact or declare what they are off by: path, bdpt, ptracer, volpath, photonmapper, povray, cycles,
/// and every row of the file. Each is asked for its version. Throws InputError for a file that cannot be read and a
/// name that no row has.
std::vector<VerifyEngine> verify_engines(const EngineChoice& choice);

/// Why the picture of an engine of this sampling of the scene lacks light that it cannot find by any number of samples;
/// empty where it finds all: light paths never reach the eye by mirrors, clear glass, clear coats or holes that it
/// looks at, nor the far parts of a plane without end under a sky.
std::string what_is_not_shown(const std::string& sampling, const SceneDescription& scene);

}  // namespace photonproof::inline harness_verify
