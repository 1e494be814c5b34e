// Random numbers for a variant, as functions of its seed.
#pragma once

#include <cstdint>

#include "scenes/base/splitmix.h"

namespace photonproof::inline harness_variants {

class VariantDraws {
 public:
  /// Each kind has a stream of its own, so that one seed gives different kinds different numbers.
  VariantDraws(std::uint64_t seed, std::uint64_t stream) : start_(splitmix64(seed, stream + 1)) {}
  double uniform() { return static_cast<double>(splitmix64(start_, ++count_) >> 11) * 0x1p-53; }
  double between(double low, double high) { return low + (high - low) * uniform(); }
  /// 0 to count - 1
  int below(int count) { return static_cast<int>(uniform() * count); }

 private:
  std::uint64_t start_, count_ = 0;
};

}  // namespace photonproof::inline harness_variants
