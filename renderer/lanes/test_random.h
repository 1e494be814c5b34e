// The tests' own random numbers, independent of the sampler under test: counter-based SplitMix64 (Steele, Lea, Flood
// 2014). The state is hashed from a name; each number mixes one step of it.
#pragma once

#include <cstdint>

#include "scenes/base/vec.h"

namespace photonproof::test {

class Random {
 public:
  explicit Random(std::uint64_t seed, std::uint64_t index = 0, std::uint64_t sample = 0)
      : state_(mix(mix(mix(mix(seed) ^ 1) + index) + sample)) {}

  /// Uniform in [0,1).
  float next() { return to_unit(next_bits() >> 40); }

  /// Uniform in [0,1)^2.
  Vec2<float> next2() {
    const std::uint64_t bits = next_bits();
    return {to_unit(bits >> 40), to_unit((bits >> 8) & 0xFFFFFF)};
  }

  std::uint64_t next_bits() {
    const std::uint64_t bits = mix(state_);
    state_ += 0x9E3779B97F4A7C15ull;
    return bits;
  }

 private:
  static float to_unit(std::uint64_t bits24) { return static_cast<float>(bits24) * 0x1p-24f; }
  static std::uint64_t mix(std::uint64_t z) {
    z += 0x9E3779B97F4A7C15ull;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
    return z ^ (z >> 31);
  }

  std::uint64_t state_;
};

}  // namespace photonproof::test
