// The content of a suite's scene, and its stored reference. A scene that only an engine reads is a file, a folder or a
// word: its bytes are its content, and its reference lies beside the suite.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "harness/metrics/metric_parameters.h"
#include "harness/suites/suite.h"
#include "reference/store/reference_store.h"
#include "scenes/description/expect.h"
#include "scenes/description/film_part.h"

namespace photonproof::inline harness_references {

struct SceneContent {
  std::string hash;
  std::optional<FilmPart> crop{};  ///< of our own scenes
};

/// Throws InputError when the scene cannot be read. Where it is an XML that we cannot parse, the message ends in the
/// key that leaves it to the engine.
SceneContent content_of(const SuiteScene& scene);

/// The scene's expect.toml; empty where there is none, or only an engine reads the scene.
std::optional<Expect> expectations_of(const SuiteScene& scene);

/// The parameters that a scene fixes. The exposure is the suite's, else that of expect.toml, else 0. Only expect.toml
/// fixes hdr_exposures. Throws InputError for an expect.toml that cannot be read.
ParameterValues viewing_of(const SuiteScene& scene);

/// The scene's stored reference of its size (reference_store.h). Throws InputError with the command that makes one.
StoredReference reference_of(const SuiteScene& scene);

/// One sentence on what the scenes that only engines read lack; empty where there are none.
std::optional<std::string> note_on_opaque(const std::vector<const SuiteScene*>& scenes);

/// The path that stands for the scene in the store: references lie beside it. It is `path` for our own scenes, and
/// <suite's folder>/references/<name>/<file name> for others.
std::filesystem::path stored_beside(const SuiteScene& scene);

/// "photonproof reference SUITE --scene NAME --from FILE"
std::string opaque_reference_command(const SuiteScene& scene);

}  // namespace photonproof::inline harness_references
