#include "renderer/core/version.h"

#include "source_hash.h"

namespace photonproof::inline renderer_core {

std::string version_line() {
  return std::string("photonproof ") + PHOTONPROOF_VERSION + " (" + PHOTONPROOF_SOURCE_HASH + ")";
}

}  // namespace photonproof::inline renderer_core
