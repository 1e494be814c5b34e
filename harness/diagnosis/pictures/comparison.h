// How far a picture is from a guess at how it came about, beyond noise and tolerance.
//
// Values are compared as square roots of what is left after clamping, which makes noise about as large in the dark as
// in the light. Over blocks of 4 x 4 pixels the mean difference d counts by what it exceeds its allowance,
// max(0, |d| - allowance)^2: noise as neighbouring pixels of the picture and of the difference show it (the lesser of
// the two, since edges look like noise), tolerance, and the rounding to 8 bits.
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
  double total = 0;           ///< summed over blocks and channels
  std::vector<double> block;  ///< row by row
};

class Comparison {
 public:
  static constexpr int side = 4;               ///< of a block
  static constexpr double unexplained = 1e12;  ///< the excess of a guess that knows nothing

  /// `ignored`: a pixel, those that say nothing (already explained, or not finite); empty: none.
  Comparison(const Image& submitted, std::optional<float> white, double tolerance, std::vector<std::uint8_t> ignored);

  /// `guess` is linear, not clamped; pixels that it does not know are NaN, and ignored.
  Excess excess(const Image& guess) const { return excess_by_rows(rows_of(guess), any); }
  /// Infinite where it is more than `most`, which is known before all of the guess was looked at.
  double total(const Image& guess, double most = any) const { return total_by_rows(rows_of(guess), most); }

  /// Writes what is compared (shown()) of a guess's row, NaN where that is unknown: 3 values a pixel.
  using Rows = std::function<void(int y, float* values)>;
  double total_by_rows(const Rows& rows, double most) const { return excess_by_rows(rows, most).total; }

  /// Mean square of what differs, in units of noise, a value's at most 16: no tolerance, and what is wholly wrong
  /// counts no more than what is plainly wrong. Tells guesses apart that are all within the tolerance.
  double mismatch(const Image& guess) const;

  int width() const { return submitted_.width; }
  int height() const { return submitted_.height; }
  int across() const { return (width() + side - 1) / side; }
  int down() const { return (height() + side - 1) / side; }
  const Image& submitted() const { return submitted_; }
  const std::vector<std::uint8_t>& ignored() const { return ignored_; }
  bool counts(std::size_t pixel) const { return ignored_.empty() || ignored_[pixel] == 0; }
  double white() const { return white_; }

  /// What is compared: sqrt(min(v, white) / white) of a linear value.
  double shown(double v) const;
  /// Of an image's values; NaN of those that are not finite.
  std::vector<float> shown_of(const Image& image) const;
  const std::vector<float>& shown_of_submitted() const { return shown_; }
  /// Median over pixels of the noise in units of shown(), from differences of neighbours.
  double noise() const { return noise_; }
  double noise_of(const Image& image) const;
  /// Of noise and of rounding, of the value with this index of Image::rgb, in units of shown().
  double variance_at(std::size_t value) const;

 private:
  Image submitted_;
  double white_, tolerance_;
  std::vector<std::uint8_t> ignored_;
  std::vector<float> shown_;             ///< of the submitted picture
  std::vector<float> known_;             ///< the same, NaN where ignored
  std::vector<float> pixel_variance_;    ///< of its neighbours' differences, around each block and channel
  std::vector<std::uint8_t> countable_;  ///< pixels of each block that are not ignored
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
