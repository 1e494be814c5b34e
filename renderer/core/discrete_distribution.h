// Samples an index with given probabilities by bisection of their sums.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace photonproof::inline renderer_core {

class DiscreteDistribution {
 public:
  DiscreteDistribution() = default;
  /// Weights >= 0, at least one of them. If all are zero, they count as equal.
  explicit DiscreteDistribution(const std::vector<double>& weights) : upper_(weights.size()) {
    double total = 0;
    for (const double w : weights) total += w;
    double sum = 0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
      sum += total > 0 ? weights[i] / total : 1 / static_cast<double>(weights.size());
      upper_[i] = sum;
    }
    // The last index of positive weight gets the part that rounding leaves short of 1.
    for (std::size_t i = upper_.size(); i-- > 0 && upper_[i] == sum;) upper_[i] = 1;
    total_ = total;
  }

  struct Drawn {
    std::size_t index;
    float probability;
    float u;  ///< the rest of the uniform number: uniform itself, in [0,1)
  };
  Drawn sample(float u) const {
    const auto at = std::upper_bound(upper_.begin(), upper_.end(), double{u});
    const auto index = std::min(static_cast<std::size_t>(at - upper_.begin()), upper_.size() - 1);
    const double p = probability_of(index);
    const double within = p > 0 ? (double{u} - lower(index)) / p : 0;
    return {index, static_cast<float>(p), std::clamp(static_cast<float>(within), 0.0f, 1 - 0x1p-24f)};
  }
  float probability(std::size_t index) const { return static_cast<float>(probability_of(index)); }
  double total() const { return total_; }
  std::size_t size() const { return upper_.size(); }

 private:
  double lower(std::size_t index) const { return index == 0 ? 0 : upper_[index - 1]; }
  double probability_of(std::size_t index) const { return upper_[index] - lower(index); }

  std::vector<double> upper_;
  double total_ = 0;
};

}  // namespace photonproof::inline renderer_core
