// The identity of this build, for --version, stats and results.json.
#pragma once

#include <string>

namespace photonproof::inline renderer_core {

/// "photonproof 0.2.0 (abcdef123456)": the version and the hash of the sources that affect an image.
std::string version_line();

}  // namespace photonproof::inline renderer_core
