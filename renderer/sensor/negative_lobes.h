// Filters with negative lobes. A filter f of integral 1 is p - n, its values above and below 0, with the integrals
// 1 + m and m. A pixel is then
//   `(1 + m) P - m N`,
// where P and N are means of camera samples with the densities p / (1 + m) and n / m. Both means are ordinary
// estimates, so the pixel is unbiased, its variance is (1 + m)^2 var P + m^2 var N, and an even image stays even.
//   Along an axis the integrals are a and b with a - b = 1. Lobes of equal signs make p, so m = a_x b_y + b_x a_y. At a
// border that is not sampled, they are integrals within the film, over their difference.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/sensor/reconstruction_filter.h"
#include "scenes/base/vec.h"

namespace photonproof::inline renderer_sensor {

class NegativeLobes {
 public:
  /// A filter without any.
  NegativeLobes() = default;
  /// For a film of this size.
  NegativeLobes(const ReconstructionFilter& filter, bool sample_border, int width, int height);

  bool any() const { return inner_ > 0; }
  /// m of the pixel.
  double subtracted(int x, int y) const;
  /// The pixel from the means of both parts' samples.
  RgbD combined(int x, int y, const RgbD& positive, const RgbD& negative) const {
    const double m = subtracted(x, y);
    return positive * (1 + m) - negative * m;
  }
  /// m away from borders.
  double subtracted() const { return inner_; }

 private:
  std::vector<double> columns_, rows_;  ///< b of each; empty without negative lobes
  double inner_ = 0;
};

/// Number of samples of the negative part beside so many of the positive one. With m / (1 + m) of them a pixel's
/// variance is least for the number of both. Two show their spread.
std::int64_t negative_samples(double subtracted, std::int64_t positive_samples);

}  // namespace photonproof::inline renderer_sensor
