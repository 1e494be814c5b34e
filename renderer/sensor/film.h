// Accumulates estimates a pixel: weighted mean and the variance of that mean. Double sums, one writer a pixel at a
// time, added in a fixed order, so that the image does not depend on threads.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "renderer/core/parallel.h"
#include "scenes/base/vec.h"
#include "scenes/images/image.h"

namespace photonproof::inline renderer_core {
class StateReader;
class StateWriter;
}  // namespace photonproof::inline renderer_core

namespace photonproof::inline renderer_sensor {

/// Whether floats hold the variances of an image's pixels: the square of a radiance that is a float need not be one.
struct VarianceInFloat {
  std::size_t lost = 0;  ///< pixels with a variance that is beyond the largest or below the least float
  /// None is beyond, and the largest is not below: a layer that says next to nothing of the lost ones is right.
  bool fits = true;
};

class Film {
 public:
  Film(int width, int height) : Film(Tile{0, 0, width, height}) {}
  /// A part of the image. Its pixels keep the coordinates they have in the whole.
  explicit Film(const Tile& window);

  /// One independent estimate of the pixel's radiance, itself the mean of `weight` samples.
  void add(int x, int y, const RgbD& radiance, double weight) {
    Pixel& p = pixels_[index(x, y)];
    p.sum += radiance * weight;
    p.sum_of_squares += radiance * radiance * weight;
    p.weight += weight;
    p.estimates += 1;
  }

  /// Several independent estimates of weight 1 at once: their sum, the sum of their squares, their number.
  void add(int x, int y, const RgbD& sum, const RgbD& sum_of_squares, std::int64_t estimates) {
    Pixel& p = pixels_[index(x, y)];
    p.sum += sum;
    p.sum_of_squares += sum_of_squares;
    p.weight += static_cast<double>(estimates);
    p.estimates += estimates;
  }

  /// After every pass of `samples` a pixel whose pixels share light paths or photons: they vary together, so that how
  /// certain the image's mean is only the passes show. A pass that was broken off does not count before it is whole.
  void end_shared_pass(double samples);
  /// Of light paths that are added by a filter wider than a pixel (scenes/images/mean_error.h).
  void set_pixels_a_splat(double pixels) { pixels_a_splat_ = pixels; }

  /// Mean and, where every pixel has at least two estimates and floats hold it, the variance of the mean:
  /// sum w (x - m)^2 / ((n - 1) sum w), unbiased where an estimate's variance is inverse to its weight. By the same
  /// formula, after two shared passes, the MeanError of the image's mean.
  /// The image is of the window's size.
  Rendering develop() const;
  /// Errors are relative to mean^2 + this, as relmse has it.
  static constexpr double relative_epsilon = 0.01;
  /// What squares of errors of pixels of such a mean are multiplied by.
  static RgbD relative_scale(const RgbD& mean) {
    const auto of = [](double v) { return 1 / (v * v + relative_epsilon); };
    return {of(mean.x), of(mean.y), of(mean.z)};
  }
  /// Root of the mean, over channel values, of the mean's variance over mean^2 + 0.01: the root of the relmse that
  /// noise alone would give, as estimated from the samples, which are taken as independent (those of a Sobol sequence
  /// are better than that). `epsilon` is what is there in place of 0.01. Empty where a pixel has fewer than two
  /// estimates.
  std::optional<double> relative_standard_error(double epsilon = relative_epsilon) const;
  /// Mean over channel values of mean^2.
  double mean_square() const;
  /// Of the estimates so far; 0 where there is none.
  RgbD mean(int x, int y) const {
    const Pixel& p = pixels_[index(x, y)];
    return p.weight > 0 ? p.sum / p.weight : RgbD(0.0);
  }
  /// Whether the layer of develop() is there, and of how many pixels it says next to nothing.
  VarianceInFloat variance_in_float() const;
  /// Pixels no estimate reached (an interrupted first pass).
  std::size_t unsampled_pixels() const;
  /// Of memory, for each pixel.
  static constexpr std::size_t bytes_a_pixel() { return sizeof(Pixel); }

  const Tile& window() const { return window_; }
  int width() const { return window_.width(); }
  int height() const { return window_.height(); }

  /// Every sum, to the bit.
  void save(StateWriter& out) const;
  /// Throws InputError when what is stored is of another window.
  void restore(StateReader& in);

 private:
  struct Pixel {
    RgbD sum{0.0}, sum_of_squares{0.0};
    double weight = 0;
    std::int64_t estimates = 0;
  };
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y - window_.y0) * static_cast<std::size_t>(window_.width()) +
           static_cast<std::size_t>(x - window_.x0);
  }

  Tile window_;
  std::vector<Pixel> pixels_;
  Pixel passes_;       ///< of the image's mean, each shared pass an estimate
  Pixel before_pass_;  ///< sums over all pixels when the last pass had ended
  double pixels_a_splat_ = 1;
};

}  // namespace photonproof::inline renderer_sensor
