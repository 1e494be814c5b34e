#include "renderer/sensor/splats.h"

namespace photonproof {

void SplatImage::add(const Splats& splats) {
  for (const Splat& s : splats)
    filter_.for_each_pixel(s.raster, window_.x1, window_.y1, [&](int x, int y, float weight) {
      if (window_.contains(x, y)) sums_[index(x, y)] += RgbD(s.value) * double{weight};
    });
}

}  // namespace photonproof
