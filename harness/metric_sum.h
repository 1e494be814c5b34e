// Sums that do not depend on anything but their terms: double, over fixed chunks, in index order.
#pragma once

#include <algorithm>
#include <cstddef>

namespace photonproof {

/// term(0) + ... + term(count - 1). Chunks keep the rounding error of millions of terms near that of a few thousand.
template <class Term>
double chunked_sum(std::size_t count, const Term& term) {
  constexpr std::size_t kChunk = 4096;
  double total = 0;
  for (std::size_t begin = 0; begin < count; begin += kChunk) {
    const std::size_t end = std::min(count, begin + kChunk);
    double chunk = 0;
    for (std::size_t i = begin; i < end; ++i) chunk += term(i);
    total += chunk;
  }
  return total;
}

/// chunked_sum / count. Precondition: count > 0.
template <class Term>
double chunked_mean(std::size_t count, const Term& term) {
  return chunked_sum(count, term) / static_cast<double>(count);
}

}  // namespace photonproof
