// Stable radix sort of indices by 64-bit keys, least digit first (Knuth, The Art of Computer Programming 3, 5.2.5).
// Digits in which no two keys differ cost one pass over the keys together.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace photonproof::inline renderer_core {

class RadixSort {
 public:
  struct Item {
    std::uint64_t key;
    std::uint32_t index;
  };
  /// Fill in any order, then sort by key; items of equal keys keep their order.
  std::vector<Item> items;

  void sort() {
    std::uint64_t differing = 0;
    for (const Item& item : items) differing |= item.key ^ items.front().key;
    scratch_.resize(items.size());
    for (int shift = 0; shift < 64; shift += digit_bits) {
      if (((differing >> shift) & digit_mask) == 0) continue;
      std::array<std::uint32_t, digit_mask + 1> next{};
      for (const Item& item : items) ++next[(item.key >> shift) & digit_mask];
      std::uint32_t total = 0;
      for (std::uint32_t& n : next) total += std::exchange(n, total);
      for (const Item& item : items) scratch_[next[(item.key >> shift) & digit_mask]++] = item;
      items.swap(scratch_);
    }
  }

 private:
  static constexpr int digit_bits = 8;
  static constexpr std::uint64_t digit_mask = (1u << digit_bits) - 1;
  std::vector<Item> scratch_;
};

}  // namespace photonproof::inline renderer_core
