#include "renderer/photons/photon_map.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "renderer/core/radix_sort.h"
#include "renderer/photons/photon_sort.h"

namespace photonproof::inline renderer_photons {
namespace {

constexpr double most_cells_along = 1 << 21;  // a cell's index is exact in floats, its key fits 63 bits

/// Photons lie on surfaces, so most cells of a grid are empty; beyond this the array costs more memory and build time
/// than the photons. Photons are then sparse, too, and gathers spend their time on finding cells. Wider cells are
/// faster there: a ball touches 4 rows of them instead of 9 (photon_map_bench).
double most_dense_cells(std::size_t photons) { return 8.0 * static_cast<double>(photons) + 262144; }

PhotonGrid grid_for(const Bounds& bounds, float radius) {
  const Vec3d extent = Vec3d(bounds.high) - Vec3d(bounds.low);
  const double widest = max_component(extent);
  // Wide enough for a finite inverse; no grid at all where the inverse would be subnormal.
  const double width = std::max({static_cast<double>(radius), widest / (most_cells_along - 1), 0x1p-120});
  PhotonGrid grid;
  grid.low = bounds.low;
  if (width > 0x1p125) return grid;
  grid.inverse_width = static_cast<float>(1 / width);
  const auto count = [&](double length) { return static_cast<std::int32_t>(std::floor(length / width)) + 1; };
  grid.count = {count(extent.x), count(extent.y), count(extent.z)};
  grid.last = Vec3f(Vec3d(grid.count.x - 1, grid.count.y - 1, grid.count.z - 1));
  return grid;
}

/// With more photons than this the sort's memory is freed: it would be more than a gigabyte.
constexpr std::size_t most_to_keep_staged = 30'000'000;

void put(Photons& photons, std::size_t slot, const StagedPhoton& p) {
  zip_photons([slot](auto& array, const auto& value) { array[slot] = value; }, photons, p);
}

}  // namespace

void PhotonMap::build(Photons photons, float radius, const Threads& threads) {
  count_ = photons.size();
  photons_ = std::move(photons);
  if (empty()) return;
  const Bounds bounds = bounds_of(photons_, threads);
  grid_ = grid_for(bounds, radius);
  if (static_cast<double>(grid_.cells()) > most_dense_cells(count_)) grid_ = grid_for(bounds, 2 * radius);
  layout_ = static_cast<double>(grid_.cells()) <= most_dense_cells(count_) ? Layout::dense : Layout::compact;
  stage_by_bucket(photons_, grid_, threads, staged_);
  photons_.resize(count_ + Photons::padding);
  for (std::size_t i = count_; i < photons_.size(); ++i) put(photons_, i, {});
  if (layout_ == Layout::dense)
    sort_into_dense_cells(staged_, threads);
  else
    sort_into_occupied_cells(staged_, threads);
  if (count_ > most_to_keep_staged) staged_ = {};
}

PhotonView PhotonMap::view() const {
  PhotonView view;
  zip_photons([](auto& pointer, const auto& array) { pointer = array.data(); }, view, photons_);
  view.count = count_;
  view.grid = grid_;
  view.cell_begin = layout_ == Layout::dense ? cell_begin_.data() : nullptr;
  view.rows = rows_.view();
  return view;
}

void PhotonMap::sort_into_dense_cells(const StagedPhotons& staged, const Threads& threads) {
  cell_begin_.resize(grid_.cells() + 1);
  cell_begin_.back() = static_cast<std::uint32_t>(count_);
  threads.for_each(staged.buckets(), [&](std::size_t bucket) {
    const std::uint32_t first = staged.begin[bucket], end = staged.begin[bucket + 1];
    const std::size_t first_cell = bucket << staged.shift;
    const std::size_t end_cell = std::min<std::size_t>((bucket + 1) << staged.shift, grid_.cells());
    std::uint32_t* begin_of = cell_begin_.data() + first_cell;

    std::vector<std::uint32_t> cell_of(end - first), order(end - first);
    std::fill(begin_of, begin_of + (end_cell - first_cell), 0);
    for (std::uint32_t i = first; i < end; ++i) {
      const StagedPhoton& p = staged.photons[i];
      __builtin_prefetch(&p + 24);  // a tenth off the whole build
      cell_of[i - first] = static_cast<std::uint32_t>(grid_.key(grid_.cell(p.x, p.y, p.z)) - first_cell);
      ++begin_of[cell_of[i - first]];
    }
    // Converts counts to ends; placing the photons from the last to the first turns these into begins.
    std::uint32_t total = first;
    for (std::size_t cell = 0; cell < end_cell - first_cell; ++cell) total = begin_of[cell] += total;
    for (std::uint32_t i = end; i-- > first;) order[--begin_of[cell_of[i - first]] - first] = i;
    for (std::uint32_t slot = first; slot < end; ++slot) put(photons_, slot, staged.photons[order[slot - first]]);
  });
}

void PhotonMap::sort_into_occupied_cells(const StagedPhotons& staged, const Threads& threads) {
  struct Cells {
    std::vector<std::uint64_t> keys;
    std::vector<std::uint32_t> begins;
  };
  std::vector<Cells> parts(staged.buckets());
  threads.for_each(staged.buckets(), [&](std::size_t bucket) {
    RadixSort order;
    for (std::uint32_t i = staged.begin[bucket]; i < staged.begin[bucket + 1]; ++i) {
      const StagedPhoton& p = staged.photons[i];
      order.items.push_back({grid_.key(grid_.cell(p.x, p.y, p.z)), i});
    }
    order.sort();
    Cells& cells = parts[bucket];
    std::uint32_t slot = staged.begin[bucket];
    for (const auto& [key, from] : order.items) {
      if (cells.keys.empty() || cells.keys.back() != key) {
        cells.keys.push_back(key);
        cells.begins.push_back(slot);
      }
      put(photons_, slot++, staged.photons[from]);
    }
  });
  Cells all;
  for (const Cells& cells : parts) {
    all.keys.insert(all.keys.end(), cells.keys.begin(), cells.keys.end());
    all.begins.insert(all.begins.end(), cells.begins.begin(), cells.begins.end());
  }
  rows_ = PhotonRows(grid_, all.keys, std::move(all.begins), static_cast<std::uint32_t>(count_));
}

}  // namespace photonproof::inline renderer_photons
