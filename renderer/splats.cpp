#include "renderer/splats.h"

namespace photonproof {

void SplatImage::add(const Splats& splats) {
  for (const Splat& s : splats) {
    if (!(s.raster.x >= 0 && s.raster.y >= 0)) continue;
    const auto x = static_cast<std::size_t>(s.raster.x), y = static_cast<std::size_t>(s.raster.y);
    if (x >= std::size_t(width_) || y >= std::size_t(height_)) continue;
    sums_[y * std::size_t(width_) + x] += RgbD(s.value);
  }
}

}  // namespace photonproof
