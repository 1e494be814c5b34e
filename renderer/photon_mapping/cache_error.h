// What an irradiance cache has wrong, learned before the first pass: at some pixels, drawn from the seed and
// weighted by how likely they were, two camera paths end at points of their own, where light is gathered once more, by
// rays and photons that neither the records nor the other path have. With D the interpolated light less the gathered
// one, times what the path carries to its pixel,
//   mean over pixels of D_1 D_2 / (image^2 + 0.01)
// is the square of the image's bias by the cache as relmse counts it, since what is gathered is independent: its noise
// adds nothing in expectation. What records and gathered light have wrong alike it does not see.
#pragma once

#include <utility>
#include <vector>

#include "renderer/sensor/film.h"
#include "scenes/base/vec.h"

namespace photonproof::inline renderer_photon_mapping {

class CacheError {
 public:
  struct Pixel {
    int x = 0, y = 0;
    double share = 0;   ///< of the image that it stands for
    RgbD product{0.0};  ///< D_1 D_2
  };
  CacheError() = default;
  explicit CacheError(std::vector<Pixel> pixels) : pixels_(std::move(pixels)) {}

  /// Of the image by the cache, as far as it is known; never negative.
  double squared_bias(const Film& image) const;

 private:
  std::vector<Pixel> pixels_;
};

}  // namespace photonproof::inline renderer_photon_mapping
