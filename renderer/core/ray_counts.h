// Rays traced, by kind, as counted by one tile or chunk.
#pragma once

#include <cstdint>

namespace photonproof::inline renderer_core {

struct RayCounts {
  std::uint64_t camera = 0, bounce = 0, shadow = 0, photon = 0;
};

}  // namespace photonproof::inline renderer_core
