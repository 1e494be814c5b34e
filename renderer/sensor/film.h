// Accumulates estimates per pixel: weighted mean and the variance of that mean. Double sums, one writer per pixel at a
// time, added in a fixed order, so that the image does not depend on threads.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "renderer/core/parallel.h"
#include "renderer/sensor/negative_lobes.h"
#include "scenes/base/vec.h"
#include "scenes/images/image.h"

namespace photonproof::inline renderer_core {
class StateReader;
class StateWriter;
}  // namespace photonproof::inline renderer_core

namespace photonproof::inline renderer_sensor {

/// Whether floats hold the variances of an image's pixels: the square of a radiance that is a float may overflow.
struct VarianceInFloat {
  std::size_t lost = 0;  ///< Pixels with a variance beyond the largest or below the least float.
  /// No variance is beyond, and the largest is not below. A layer with almost no variance at the lost ones is then
  /// right.
  bool fits = true;
};

class Film {
 public:
  Film(int width, int height) : Film(Tile{0, 0, width, height}) {}
  /// A part of the image. Its pixels keep their coordinates in the whole image.
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
    pixels_[index(x, y)].add(sum, sum_of_squares, estimates);
  }

  /// Call before the first estimate where samples of a filter's negative lobes are added by themselves.
  void separate(const NegativeLobes& lobes);
  /// Several independent estimates of weight 1 from the negative lobes.
  void add_negative(int x, int y, const RgbD& sum, const RgbD& sum_of_squares, std::int64_t estimates) {
    negative_[index(x, y)].add(sum, sum_of_squares, estimates);
  }

  /// Call after every pass of `samples` per pixel whose pixels share light paths or photons. They are correlated, so
  /// only the passes show the error of the image's mean. An interrupted pass does not count until it is whole.
  void end_shared_pass(double samples);
  /// Sets the value for light paths that are added by a filter wider than a pixel (scenes/images/mean_error.h).
  void set_pixels_a_splat(double pixels) { pixels_a_splat_ = pixels; }

  /// The mean and, where every pixel has at least two estimates and floats hold it, the variance of the mean. This is
  /// sum w (x - m)^2 / ((n - 1) sum w), unbiased where an estimate's variance is inverse to its weight. After two
  /// shared passes, the same formula gives the MeanError of the image's mean.
  /// The image is of the window's size.
  Rendering develop() const;
  /// Errors are relative to mean^2 + this, as in relmse.
  static constexpr double relative_epsilon = 0.01;
  /// Factor on squared errors of pixels with such a mean.
  static RgbD relative_scale(const RgbD& mean) {
    const auto of = [](double v) { return 1 / (v * v + relative_epsilon); };
    return {of(mean.x), of(mean.y), of(mean.z)};
  }
  /// Root of the mean, over channel values, of the mean's variance over mean^2 + 0.01. This estimates the root of the
  /// relmse that noise alone would cause. Samples count as independent (those of a Sobol sequence are better than
  /// that). `epsilon` replaces 0.01. Empty where a pixel has fewer than two estimates.
  std::optional<double> relative_standard_error(double epsilon = relative_epsilon) const;
  /// Mean over channel values of mean^2.
  double mean_square() const;
  /// Mean of the estimates so far; 0 where there is none.
  RgbD mean(int x, int y) const { return mean(index(x, y)); }
  /// Whether develop() gives the variance layer, and the number of pixels whose variance it cannot hold.
  VarianceInFloat variance_in_float() const;
  /// Pixels without an estimate (after an interrupted first pass).
  std::size_t unsampled_pixels() const;
  /// Memory per pixel.
  static constexpr std::size_t bytes_a_pixel() { return sizeof(Pixel); }

  const Tile& window() const { return window_; }
  int width() const { return window_.width(); }
  int height() const { return window_.height(); }

  /// Every sum, to the bit.
  void save(StateWriter& out) const;
  /// Throws InputError when the stored state is of another window.
  void restore(StateReader& in);

 private:
  struct Pixel {
    RgbD sum{0.0}, sum_of_squares{0.0};
    double weight = 0;
    std::int64_t estimates = 0;

    /// Estimates of weight 1.
    void add(const RgbD& values, const RgbD& squares, std::int64_t number) {
      sum += values;
      sum_of_squares += squares;
      weight += static_cast<double>(number);
      estimates += number;
    }
    RgbD mean() const { return weight > 0 ? sum / weight : RgbD(0.0); }
    RgbD spread() const { return sum_of_squares / weight - mean() * mean(); }
  };
  RgbD mean(std::size_t pixel) const;
  bool has_variance(std::size_t pixel) const {
    return pixels_[pixel].estimates >= 2 && (negative_.empty() || negative_[pixel].estimates >= 2);
  }
  /// The variance of the mean of a pixel that has it.
  RgbD variance(std::size_t pixel) const;
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y - window_.y0) * static_cast<std::size_t>(window_.width()) +
           static_cast<std::size_t>(x - window_.x0);
  }

  Tile window_;
  std::vector<Pixel> pixels_;
  std::vector<Pixel> negative_;     ///< Estimates of the negative lobes; empty where none are separate.
  std::vector<double> subtracted_;  ///< Factors of the negative lobes (negative_lobes.h).
  Pixel passes_;                    ///< of the image's mean; each shared pass is an estimate
  Pixel before_pass_;               ///< sums over all pixels at the end of the last pass
  double pixels_a_splat_ = 1;
};

}  // namespace photonproof::inline renderer_sensor
