// The difference of a picture from a guess at its origin, beyond noise and tolerance.
//
// Values are compared as square roots after clamping, which makes noise about equal in the dark and in the light. In
// blocks of 4 x 4 pixels the mean difference d counts as far as it exceeds its allowance, max(0, |d| - allowance)^2.
// The allowance includes noise, tolerance, and the rounding to 8 bits. Noise is estimated from neighbouring pixels, of
// the picture and of the difference. The lesser of the two counts, since edges look like noise.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "scenes/images/image.h"

namespace photonproof::inline harness_diagnosis_pictures {

struct Excess {
  double total = 0;           ///< Summed over blocks and channels.
  std::vector<double> block;  ///< Row by row.
};

class Comparison {
 public:
  static constexpr int side = 4;               ///< Pixels of a block's side.
  static constexpr double unexplained = 1e12;  ///< The excess of a guess that knows nothing.

  /// `ignored`: for each pixel, 1 where it does not count (already explained, or not finite); empty: all count.
  Comparison(const Image& submitted, std::optional<float> white, double tolerance, std::vector<std::uint8_t> ignored);

  /// `guess` is linear and not clamped; its unknown pixels are NaN and ignored.
  Excess excess(const Image& guess) const { return excess_by_rows(rows_of(guess), any); }
  /// Infinite where it exceeds `most`; the comparison may then stop before the last row.
  double total(const Image& guess, double most = any) const { return total_by_rows(rows_of(guess), most); }

  /// Writes a row of a guess as shown() values, NaN where it is unknown: 3 values a pixel.
  using Rows = std::function<void(int y, float* values)>;
  double total_by_rows(const Rows& rows, double most) const { return excess_by_rows(rows, most).total; }

  /// Mean square of the differences in units of noise, at most 16 for each value, without tolerance. A totally wrong
  /// value thus counts no more than a clearly wrong one. It ranks guesses that are all within the tolerance.
  double mismatch(const Image& guess) const;

  int width() const { return submitted_.width; }
  int height() const { return submitted_.height; }
  int across() const { return (width() + side - 1) / side; }
  int down() const { return (height() + side - 1) / side; }
  const Image& submitted() const { return submitted_; }
  const std::vector<std::uint8_t>& ignored() const { return ignored_; }
  bool counts(std::size_t pixel) const { return ignored_.empty() || ignored_[pixel] == 0; }
  double white() const { return white_; }

  /// The value to compare: sqrt(min(v, white) / white) of a linear value.
  double shown(double v) const;
  /// shown() of an image's values; NaN for values that are not finite.
  std::vector<float> shown_of(const Image& image) const;
  const std::vector<float>& shown_of_submitted() const { return shown_; }
  /// Median over pixels of the noise in units of shown(), from differences of neighbours.
  double noise() const { return noise_; }
  double noise_of(const Image& image) const;
  /// Variance of noise and rounding at this index of Image::rgb, in units of shown().
  double variance_at(std::size_t value) const;

 private:
  Image submitted_;
  double white_, tolerance_;
  std::vector<std::uint8_t> ignored_;
  std::vector<float> shown_;             ///< shown() of the submitted picture.
  std::vector<float> known_;             ///< The same, NaN where ignored.
  std::vector<float> pixel_variance_;    ///< From neighbours' differences, around each block and channel.
  std::vector<std::uint8_t> countable_;  ///< Pixels of each block that are not ignored.
  double noise_ = 0;
  std::size_t block_of(std::size_t pixel) const;
  static constexpr double any = std::numeric_limits<double>::infinity();
  std::size_t row_values() const { return 3 * static_cast<std::size_t>(width()); }
  Rows rows_of(const Image& guess) const;
  std::vector<float> without_ignored(std::vector<float> values) const;
  std::vector<float> variances(const std::vector<float>& values) const;
  Excess excess_by_rows(const Rows& rows, double most) const;
};

}  // namespace photonproof::inline harness_diagnosis_pictures
