// Sums that depend on their terms alone: double, in a fixed order.
#pragma once

#include <algorithm>
#include <cstddef>

namespace photonproof::inline harness_pixels {

/// Computes term(0) + ... + term(count - 1) as eight sums of every eighth term. So the loop vectorises, and the
/// rounding errors of many terms stay small.
template <class Term>
double lane_sum(std::size_t count, const Term& term) {
  constexpr std::size_t lanes = 8;
  double sums[lanes] = {};
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes)
    for (std::size_t k = 0; k < lanes; ++k) sums[k] += term(i + k);
  for (std::size_t k = 0; i < count; ++i, ++k) sums[k] += term(i);
  return ((sums[0] + sums[4]) + (sums[2] + sums[6])) + ((sums[1] + sums[5]) + (sums[3] + sums[7]));
}

/// A sum that carries the rounding error of each addition along (Neumaier 1974), as accurate as twice the digits.
class ExactSum {
 public:
  void add(double v) {
    const double t = sum_ + v;
    const double larger = sum_ < v ? v : sum_, smaller = sum_ < v ? sum_ : v;  // of values that are not negative
    carry_ += (larger - t) + smaller;
    sum_ = t;
  }
  double value() const { return sum_ + carry_; }

 private:
  double sum_ = 0, carry_ = 0;
};

}  // namespace photonproof::inline harness_pixels
