#include "reference/cycles/cycles_options.h"

#include <algorithm>

namespace photonproof::inline reference_cycles {
namespace {

constexpr int most_batches = 16, least_samples = 2;

/// SplitMix64 (Steele, Lea and Flood 2014): the n-th number of a seed's sequence.
std::uint64_t mixed(std::uint64_t seed, std::uint64_t n) {
  std::uint64_t z = seed + (n + 1) * 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

}  // namespace

std::vector<CyclesBatch> cycles_batches(int samples, std::uint64_t seed) {
  const int count = std::clamp(samples / least_samples, 1, most_batches);
  std::vector<CyclesBatch> batches;
  for (int i = 0; i < count; ++i) {
    const int size = samples / count + (i < samples % count ? 1 : 0);
    batches.push_back({size, static_cast<std::uint32_t>(mixed(seed, static_cast<std::uint64_t>(i)) >> 33)});
  }
  return batches;
}

}  // namespace photonproof::inline reference_cycles
