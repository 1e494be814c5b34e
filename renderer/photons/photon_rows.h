// The occupied cells of a grid that has far more cells than photons. Each occupied row along x has its cells in order,
// and a hash table finds the row. A row's coordinates are compared, so cells whose hashes collide are never confused.
// Neighbouring cells of a row stay one run of photons, as in the dense grid.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/lanes/always_inline.h"
#include "renderer/photons/photon_grid.h"

namespace photonproof::inline renderer_photons {

/// Pointers into a PhotonRows, for code that holds no containers.
struct PhotonRowsView {
  struct Row {
    std::int32_t y, z;
    std::uint32_t first_cell, end_cell;
  };

  const Row* rows = nullptr;  ///< in order of z, then y
  std::uint32_t row_count = 0;
  const std::uint32_t* slots = nullptr;  ///< open addressing: index of a row, or `empty`
  int hash_shift = 63;                   ///< 64 - log2(slots)
  const std::int32_t* cell_x = nullptr;
  const std::uint32_t* cell_begin = nullptr;  ///< first photon of each occupied cell, one past the last

  static constexpr std::uint32_t empty = 0xFFFFFFFF;

  PHOTONPROOF_ALWAYS_INLINE std::uint64_t slot_of(std::uint64_t key) const {
    return (key * 0x9E3779B97F4A7C15ull) >> hash_shift;  // Knuth's multiplicative hashing by the golden ratio
  }

  /// Calls visit(begin, end) for the photons in cells [low_x, high_x] of the row, if there are any.
  template <class Visit>
  PHOTONPROOF_ALWAYS_INLINE void visit_row(const Row& row, std::int32_t low_x, std::int32_t high_x,
                                           Visit&& visit) const {
    const std::uint32_t first = first_not_below(low_x, row.first_cell, row.end_cell);
    const std::uint32_t end = first_not_below(high_x + 1, first, row.end_cell);
    if (first < end) visit(cell_begin[first], cell_begin[end]);
  }

  /// Calls visit(begin, end) for the runs of photons in a range of cells, in ascending order.
  template <class Visit>
  PHOTONPROOF_ALWAYS_INLINE void for_each_run(const PhotonGrid& grid, const PhotonGrid::Range& range,
                                              Visit&& visit) const {
    const auto wanted = static_cast<std::uint64_t>(range.high.y - range.low.y + 1) *
                        static_cast<std::uint64_t>(range.high.z - range.low.z + 1);
    if (wanted > row_count) {
      for (std::uint32_t r = 0; r < row_count; ++r) {
        const Row& row = rows[r];
        if (row.y >= range.low.y && row.y <= range.high.y && row.z >= range.low.z && row.z <= range.high.z)
          visit_row(row, range.low.x, range.high.x, visit);
      }
      return;
    }
    const std::uint64_t mask = (std::uint64_t{1} << (64 - hash_shift)) - 1;
    for (std::int32_t z = range.low.z; z <= range.high.z; ++z) {
      for (std::int32_t y = range.low.y; y <= range.high.y; ++y) {
        for (std::uint64_t slot = slot_of(grid.row(y, z)); slots[slot] != empty; slot = (slot + 1) & mask) {
          const Row& row = rows[slots[slot]];
          if (row.y != y || row.z != z) continue;
          visit_row(row, range.low.x, range.high.x, visit);
          break;
        }
      }
    }
  }

 private:
  PHOTONPROOF_ALWAYS_INLINE std::uint32_t first_not_below(std::int32_t x, std::uint32_t first,
                                                          std::uint32_t end) const {
    while (first < end) {
      const std::uint32_t middle = first + (end - first) / 2;
      if (cell_x[middle] < x)
        first = middle + 1;
      else
        end = middle;
    }
    return first;
  }
};

class PhotonRows {
 public:
  PhotonRows() = default;
  /// `keys` (PhotonGrid::key) of the occupied cells in ascending order, and the first photon of each; `end` is one past
  /// the last photon.
  PhotonRows(const PhotonGrid& grid, const std::vector<std::uint64_t>& keys, std::vector<std::uint32_t> begins,
             std::uint32_t end);

  std::uint64_t cells() const { return cell_x_.size(); }
  PhotonRowsView view() const {
    return {rows_.data(),  static_cast<std::uint32_t>(rows_.size()), slots_.data(), hash_shift_, cell_x_.data(),
            begins_.data()};
  }

 private:
  std::vector<PhotonRowsView::Row> rows_;
  std::vector<std::uint32_t> slots_;
  int hash_shift_ = 63;
  std::vector<std::int32_t> cell_x_;
  std::vector<std::uint32_t> begins_;
};

}  // namespace photonproof::inline renderer_photons
