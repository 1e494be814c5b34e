// Options of a rendering by Cycles.
#pragma once

#include <cstdint>
#include <string>

namespace photonproof::inline reference_cycles {

struct CyclesOptions {
  int width = 0;    ///< In pixels. 0: the scene's film.
  int height = 0;   ///< In pixels. 0: the scene's film.
  int samples = 0;  ///< Per pixel. 0: the scene's sampler.
  int threads = 0;  ///< 0: every core.
  std::uint64_t seed = 1;
  std::string stem = "scene";  ///< Prefix of the files that the text reads from its folder.
};

}  // namespace photonproof::inline reference_cycles
