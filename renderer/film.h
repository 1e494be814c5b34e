// Accumulates estimates a pixel: weighted mean and the variance of that mean. Double sums, one writer a pixel at a
// time, added in a fixed order, so that the image does not depend on threads.
#pragma once

#include <vector>

#include "scenes/image.h"
#include "scenes/vec.h"

namespace photonproof {

class Film {
 public:
  Film(int width, int height);

  /// One independent estimate of the pixel's radiance, itself the mean of `weight` samples.
  void add(int x, int y, const RgbD& radiance, double weight) {
    Pixel& p = pixels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)];
    p.sum += radiance * weight;
    p.sum_of_squares += radiance * radiance * weight;
    p.weight += weight;
    p.estimates += 1;
  }

  /// Several independent estimates of weight 1 at once: their sum, the sum of their squares, their number.
  void add(int x, int y, const RgbD& sum, const RgbD& sum_of_squares, int estimates) {
    Pixel& p = pixels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)];
    p.sum += sum;
    p.sum_of_squares += sum_of_squares;
    p.weight += estimates;
    p.estimates += estimates;
  }

  /// Mean and, where every pixel has at least two estimates, the variance of the mean:
  /// sum w (x - m)^2 / ((n - 1) sum w), unbiased where an estimate's variance is inverse to its weight.
  Rendering develop() const;
  /// Pixels no estimate reached (an interrupted first pass).
  std::size_t unsampled_pixels() const;

  int width() const { return width_; }
  int height() const { return height_; }

 private:
  struct Pixel {
    RgbD sum{0.0}, sum_of_squares{0.0};
    double weight = 0;
    int estimates = 0;
  };
  int width_, height_;
  std::vector<Pixel> pixels_;
};

}  // namespace photonproof
