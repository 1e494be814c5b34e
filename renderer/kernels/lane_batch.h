// Paths in progress as a structure of arrays: one column per word of state, one row per lane. A pack of rows is loaded,
// advanced, and its survivors are appended to another batch, so that packs stay full.
#pragma once

#include <cstddef>
#include <cstdint>

#include "renderer/lanes/lane.h"

namespace photonproof::inline renderer_kernels {

/// State<F> has columns(state, visit), which calls visit(member) for every member that is an F or a UInt<F>, always in
/// the same order. The caller owns the memory.
template <template <class> class State, class F>
class LaneBatch {
  static_assert(sizeof(State<F>) == State<F>::column_count * sizeof(F), "column_count is not the number of columns");

 public:
  static constexpr std::size_t slack = 16;  ///< rows that a pack may touch beyond the last one
  static constexpr std::size_t words(std::size_t capacity) { return State<F>::column_count * (capacity + slack); }

  LaneBatch(std::uint32_t* memory, std::size_t capacity) : memory_(memory), stride_(capacity + slack) {}

  std::size_t size() const { return size_; }
  void clear() { size_ = 0; }

  void load_rows(std::size_t first, State<F>& state) const {
    const std::uint32_t* row = memory_ + first;
    State<F>::columns(state, [&](auto& member) {
      load_into(member, row);
      row += stride_;
    });
  }
  void append(const State<F>& state, const Mask<F>& mask) {
    const std::uint32_t bits = to_bits(mask);
    if (bits == 0) return;
    std::uint32_t* row = memory_ + size_;
    State<F>::columns(state, [&](const auto& member) {
      compress_store(member, bits, row);
      row += stride_;
    });
    size_ += static_cast<std::size_t>(std::popcount(bits));
  }

 private:
  std::uint32_t* memory_;
  std::size_t stride_;
  std::size_t size_ = 0;
};

}  // namespace photonproof::inline renderer_kernels
