// Sums over blocks of 4 x 4 pixels that need only a few rows of a picture at a time. A row has 3 values a pixel; values
// that are not finite are left out.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace photonproof::inline harness_diagnosis_pictures {

/// The variance of noise that neighbours do not share: half the mean square of differences of neighbours. The sums go
/// over a row of blocks, each with a pixel around it.
class NeighbourSquares {
 public:
  explicit NeighbourSquares(std::size_t row_values);
  void clear();
  /// Adds the pixels of a row, each with its right and lower neighbour.
  void add(const float* row, const float* below);
  /// Writes three values for every block of the row of blocks; 0 where no differences are known.
  void variances(float* of_blocks) const;

 private:
  std::vector<float> squares_, counts_;  ///< sums of columns
};

/// Sums over the blocks of one row of blocks: differences and expected values.
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
  std::vector<float> difference_, expected_, count_;  ///< sums of columns
};

/// The rows of `submitted`, of `row_values` each, less those of `rows`; a few at a time, from first to last.
class DifferenceBand {
 public:
  DifferenceBand(const std::function<void(int y, float* values)>& rows, const std::vector<float>& submitted,
                 std::size_t row_values);
  /// Holds rows first to end - 1. Neither decreases between calls, and `first` is at most the last `end`.
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
