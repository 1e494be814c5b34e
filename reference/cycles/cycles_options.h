// Options of a rendering by Cycles.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace photonproof::inline reference_cycles {

struct CyclesOptions {
  int width = 0;    ///< In pixels. 0: the scene's film.
  int height = 0;   ///< In pixels. 0: the scene's film.
  int samples = 0;  ///< Per pixel. 0: the scene's sampler.
  int threads = 0;  ///< 0: every core.
  std::uint64_t seed = 1;
  std::string stem = "scene";  ///< Prefix of the files that the text reads from its folder.
};

/// Images with independent random numbers; their mean is the image and their spread its variance.
struct CyclesBatch {
  int samples = 0;
  std::uint32_t seed = 0;  ///< 31 bits, as many as Blender takes
};

/// A pixel's samples in up to 16 batches of nearly equal size; one batch where there are too few samples for a
/// meaningful spread. Seeds are distinct and follow from `seed`.
std::vector<CyclesBatch> cycles_batches(int samples, std::uint64_t seed);

}  // namespace photonproof::inline reference_cycles
