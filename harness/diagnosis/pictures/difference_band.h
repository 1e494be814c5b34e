// Sums over blocks of 4 x 4 pixels that need no more than a few rows of a picture at a time. A row has 3 values a
// pixel; what is not finite is left out.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace photonproof::inline harness_diagnosis_pictures {

/// Half the mean square of differences of neighbours is the variance of noise that neighbours do not share. Over a row
/// of blocks, each with a pixel around it.
class NeighbourSquares {
 public:
  explicit NeighbourSquares(std::size_t row_values);
  void clear();
  /// Pixels of a row, each with those right and below.
  void add(const float* row, const float* below);
  /// Three of every block of the row of blocks; 0 where no differences are known.
  void variances(float* of_blocks) const;

 private:
  std::vector<float> squares_, counts_;  ///< of columns
};

/// Of one row of blocks: what differs, and what is expected there.
class BlockSums {
 public:
  struct Sum {
    double difference = 0, expected = 0, count = 0;
  };

  explicit BlockSums(std::size_t row_values);
  void clear();
  void add(const float* difference, const float* expected);
  Sum of_block(std::size_t block, std::size_t channel) const;

 private:
  std::vector<float> difference_, expected_, count_;  ///< of columns
};

/// The rows of `submitted`, of `row_values` each, less those that `rows` writes; a few at a time, from first to last.
class DifferenceBand {
 public:
  DifferenceBand(const std::function<void(int y, float* values)>& rows, const std::vector<float>& submitted,
                 std::size_t row_values);
  /// Of rows first to end - 1; neither less than before, and first not beyond what was held.
  void hold(int first, int end);
  const float* expected(int y) const { return &expected_[at(y)]; }
  const float* difference(int y) const { return &difference_[at(y)]; }

 private:
  const std::function<void(int y, float* values)>& rows_;
  const std::vector<float>& submitted_;
  std::size_t row_values_;
  int first_ = 0, end_ = 0;
  std::vector<float> expected_, difference_;
  std::size_t at(int y) const { return static_cast<std::size_t>(y - first_) * row_values_; }
};

}  // namespace photonproof::inline harness_diagnosis_pictures
