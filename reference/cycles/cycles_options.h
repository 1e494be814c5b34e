// What one chooses about a rendering by Cycles.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace photonproof::inline reference_cycles {

struct CyclesOptions {
  int width = 0;    ///< pixels; 0: the scene's film
  int height = 0;   ///< pixels; 0: the scene's film
  int samples = 0;  ///< a pixel; 0: the scene's sampler
  int threads = 0;  ///< 0: every core
  std::uint64_t seed = 1;
  std::string stem = "scene";  ///< starts the names of files that the text reads from its folder
};

/// Pictures by random numbers of their own, whose mean is the image and whose spread its variance.
struct CyclesBatch {
  int samples = 0;
  std::uint32_t seed = 0;  ///< 31 bits, as many as Blender takes
};

/// The samples of a pixel in up to 16 batches of as equal a size as can be; a single one where there are too few for
/// that to mean anything. Seeds follow from `seed`, and differ.
std::vector<CyclesBatch> cycles_batches(int samples, std::uint64_t seed);

}  // namespace photonproof::inline reference_cycles
