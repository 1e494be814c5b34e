#include "renderer/photons/photon_rows.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace photonproof::inline renderer_photons {

PhotonRows::PhotonRows(const PhotonGrid& grid, const std::vector<std::uint64_t>& keys,
                       std::vector<std::uint32_t> begins, std::uint32_t end)
    : begins_(std::move(begins)) {
  begins_.push_back(end);
  cell_x_.reserve(keys.size());
  const auto across = static_cast<std::uint64_t>(grid.count.x);
  const auto up = static_cast<std::uint64_t>(grid.count.y);
  for (const std::uint64_t key : keys) {
    const std::uint64_t row = key / across;
    const auto y = static_cast<std::int32_t>(row % up);
    const auto z = static_cast<std::int32_t>(row / up);
    const auto cell = static_cast<std::uint32_t>(cell_x_.size());
    if (rows_.empty() || rows_.back().y != y || rows_.back().z != z) rows_.push_back({y, z, cell, cell});
    ++rows_.back().end_cell;
    cell_x_.push_back(static_cast<std::int32_t>(key - row * across));
  }

  const std::uint64_t slots = std::bit_ceil(std::max<std::uint64_t>(2, 2 * rows_.size()));
  hash_shift_ = 64 - std::countr_zero(slots);
  slots_.assign(slots, PhotonRowsView::empty);
  for (std::uint32_t r = 0; r < rows_.size(); ++r) {
    std::uint64_t slot = view().slot_of(grid.row(rows_[r].y, rows_[r].z));
    while (slots_[slot] != PhotonRowsView::empty) slot = (slot + 1) & (slots - 1);
    slots_[slot] = r;
  }
}

}  // namespace photonproof::inline renderer_photons
