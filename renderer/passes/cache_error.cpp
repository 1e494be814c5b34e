#include "renderer/passes/cache_error.h"

#include <algorithm>

namespace photonproof {

double CacheError::squared_bias(const Film& image) const {
  double sum = 0;
  const auto part = [](double product, double mean) { return product / (mean * mean + Film::relative_epsilon); };
  for (const Pixel& at : pixels_) {
    const RgbD mean = image.mean(at.x, at.y);
    sum += at.share * (part(at.product.x, mean.x) + part(at.product.y, mean.y) + part(at.product.z, mean.z));
  }
  return std::max(0.0, sum / 3);
}

}  // namespace photonproof
