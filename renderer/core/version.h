// What this build is, for --version, stats and results.json.
#pragma once

#include <string>

namespace photonproof::inline renderer_core {

/// "photonproof 0.1.0 (abcdef123456)": the version and the hash of the sources that decide an image.
std::string version_line();

}  // namespace photonproof::inline renderer_core
