// Error of an irradiance cache, measured before the first pass. Some pixels are drawn from the seed and weighted by the
// inverse of their probability. In each, two camera paths end at points of their own. There light is gathered once
// more, by rays and photons that neither the records nor the other path use. D is the interpolated light less the
// gathered light, times the path's weight in its pixel. The mean over pixels of
//   `D_1 D_2 / (image^2 + 0.01)`
// is the square of the cache's bias in the image, in units of relmse. The gathered values are independent, so their
// noise adds nothing in expectation. Errors that records and gathered light share are not detected.
#pragma once

#include <utility>
#include <vector>

#include "renderer/sensor/film.h"
#include "scenes/base/vec.h"

namespace photonproof::inline renderer_irradiance {

class CacheError {
 public:
  struct Pixel {
    int x = 0, y = 0;
    double share = 0;   ///< share of the image that it stands for
    RgbD product{0.0};  ///< D_1 D_2
  };
  CacheError() = default;
  explicit CacheError(std::vector<Pixel> pixels) : pixels_(std::move(pixels)) {}

  /// Squared bias of the image by the cache, as far as it is known; never negative.
  double squared_bias(const Film& image) const;

 private:
  std::vector<Pixel> pixels_;
};

}  // namespace photonproof::inline renderer_irradiance
