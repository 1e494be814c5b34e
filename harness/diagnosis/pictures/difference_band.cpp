#include "harness/diagnosis/pictures/difference_band.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "harness/diagnosis/pictures/comparison.h"

namespace photonproof::inline harness_diagnosis_pictures {
namespace {

constexpr auto side = static_cast<std::size_t>(Comparison::side);

float known(float v) { return std::abs(v) <= std::numeric_limits<float>::max() ? 1.0f : 0.0f; }
float or_zero(float v) { return std::abs(v) <= std::numeric_limits<float>::max() ? v : 0.0f; }

}  // namespace

NeighbourSquares::NeighbourSquares(std::size_t row_values) : squares_(row_values), counts_(row_values) {}

void NeighbourSquares::clear() {
  std::ranges::fill(squares_, 0.0f);
  std::ranges::fill(counts_, 0.0f);
}

void NeighbourSquares::add(const float* row, const float* below) {
  for (std::size_t i = 0; i + 3 < squares_.size(); ++i) {
    const float right = row[i + 3] - row[i], down = below[i] - row[i];
    squares_[i] += or_zero(right) * or_zero(right) / 2 + or_zero(down) * or_zero(down) / 2;
    counts_[i] += known(right) + known(down);
  }
}

void NeighbourSquares::variances(float* of_blocks) const {
  const std::size_t width = squares_.size() / 3;
  for (std::size_t begin = 0; begin < width; begin += side)
    for (std::size_t c = 0; c < 3; ++c) {
      double sum = 0, count = 0;
      for (std::size_t x = begin == 0 ? 0 : begin - 1; x < std::min(width - 1, begin + side + 1); ++x) {
        sum += double{squares_[3 * x + c]};
        count += double{counts_[3 * x + c]};
      }
      *of_blocks++ = count > 0 ? static_cast<float>(sum / count) : 0;
    }
}

BlockSums::BlockSums(std::size_t row_values) : difference_(row_values), expected_(row_values), count_(row_values) {}

void BlockSums::clear() {
  for (std::vector<float>* columns : {&difference_, &expected_, &count_}) std::ranges::fill(*columns, 0.0f);
}

void BlockSums::add(const float* difference, const float* expected) {
  for (std::size_t i = 0; i < count_.size(); ++i) {
    difference_[i] += or_zero(difference[i]);
    expected_[i] += known(difference[i]) != 0 ? expected[i] : 0;
    count_[i] += known(difference[i]);
  }
}

BlockSums::Sum BlockSums::of_block(std::size_t block, std::size_t channel) const {
  Sum sum;
  for (std::size_t x = block * side; x < std::min((block + 1) * side, count_.size() / 3); ++x) {
    sum.difference += double{difference_[3 * x + channel]};
    sum.expected += double{expected_[3 * x + channel]};
    sum.count += double{count_[3 * x + channel]};
  }
  return sum;
}

DifferenceBand::DifferenceBand(const std::function<void(int y, float* values)>& rows,
                               const std::vector<float>& submitted, std::size_t row_values)
    : rows_(rows), submitted_(submitted), row_values_(row_values) {}

void DifferenceBand::hold(int first, int end) {
  for (std::vector<float>* values : {&expected_, &difference_}) {
    values->erase(values->begin(), values->begin() + static_cast<std::ptrdiff_t>(at(first)));
    values->resize(static_cast<std::size_t>(end - first) * row_values_);
  }
  first_ = first;
  for (; end_ < end; ++end_) {
    float* const expected = &expected_[at(end_)];
    rows_(end_, expected);
    for (std::size_t i = 0; i < row_values_; ++i)
      difference_[at(end_) + i] = submitted_[static_cast<std::size_t>(end_) * row_values_ + i] - expected[i];
  }
}

}  // namespace photonproof::inline harness_diagnosis_pictures
