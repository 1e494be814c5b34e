// Chooses the compiled loops that this processor runs.

#include <vector>

#include "harness/pixels/pixel_loops.h"
#include "scenes/base/processor.h"

namespace photonproof::inline harness_pixels {

#if defined(__x86_64__)
extern const PixelLoops pixel_loops_v2, pixel_loops_v3, pixel_loops_v4;
#else
extern const PixelLoops pixel_loops_native;
#endif

const PixelLoops* const* available_pixel_loops() {
  static const std::vector<const PixelLoops*> available = [] {
    std::vector<const PixelLoops*> loops;
#if defined(__x86_64__)
    if (x86_64_level() >= 4) loops.push_back(&pixel_loops_v4);
    if (x86_64_level() >= 3) loops.push_back(&pixel_loops_v3);
    loops.push_back(&pixel_loops_v2);
#else
    loops.push_back(&pixel_loops_native);
#endif
    loops.push_back(nullptr);
    return loops;
  }();
  return available.data();
}

const PixelLoops& pixel_loops() { return **available_pixel_loops(); }

}  // namespace photonproof::inline harness_pixels
