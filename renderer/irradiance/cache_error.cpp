#include "renderer/irradiance/cache_error.h"

#include <algorithm>

namespace photonproof::inline renderer_irradiance {

double CacheError::squared_bias(const Film& image) const {
  double sum = 0;
  for (const Pixel& at : pixels_) {
    const RgbD relative = at.product * Film::relative_scale(image.mean(at.x, at.y));
    sum += at.share * (relative.x + relative.y + relative.z);
  }
  return std::max(0.0, sum / 3);
}

}  // namespace photonproof::inline renderer_irradiance
