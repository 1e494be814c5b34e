// Photons sorted into the cells of a uniform grid, structure of arrays; immutable once built. The layout follows the
// usual fixed-radius hash grid (Georgiev's SmallVCM explains one), with the cells of a row along x adjacent, so that a
// query reads a few contiguous runs.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/core/parallel.h"
#include "renderer/photons/photon_sort.h"
#include "renderer/photons/photon_view.h"
#include "renderer/photons/photons.h"

namespace photonproof::inline renderer_photons {

struct StagedPhotons;

class PhotonMap {
 public:
  /// Cells are found by an array over all of them while they are few enough, else by a hash of the occupied ones.
  enum class Layout { dense, compact };

  PhotonMap() = default;
  /// Cells are `radius` wide, or twice that where there would be more than 8 for each photon and 2^18 more; if there
  /// still are, the map is compact. (Wider only where an axis would have more than 2^21.) Queries may use any radius,
  /// and are fastest near that one. The map is the same at any number of threads. It keeps the photons' arrays; there
  /// must be fewer than 2^31 photons.
  PhotonMap(Photons photons, float radius, const Threads& threads) { build(std::move(photons), radius, threads); }
  /// Rebuilds this map from other photons. It keeps its memory, including up to a gigabyte of the sort's (34 bytes per
  /// photon). So a render of many passes touches new pages in the first only.
  void build(Photons photons, float radius, const Threads& threads);

  std::size_t size() const { return count_; }
  bool empty() const { return count_ == 0; }
  Layout layout() const { return layout_; }
  /// Number of indexed cells: all of a dense grid, the occupied ones of a compact one.
  std::uint64_t cells() const { return layout_ == Layout::dense ? grid_.cells() : rows_.cells(); }

  PhotonView view() const;
  Photon operator[](std::size_t i) const { return photons_[i]; }

  /// PhotonView's gathers, for callers who make few.
  template <class Visit>
  void for_each_run(const Vec3f& p, float radius, Visit&& visit) const {
    view().for_each_run(p, radius, visit);
  }
  template <class Visit>
  void for_each_within(const Vec3f& p, float radius, Visit&& visit) const {
    view().for_each_within(p, radius, visit);
  }
  /// Queries made in the order of their keys find the photons they share in the cache (query_order.h).
  std::uint64_t cell_order_key(const Vec3f& p) const { return grid_.key(grid_.cell(p.x, p.y, p.z)); }

 private:
  void sort_into_dense_cells(const StagedPhotons& staged, const Threads& threads);
  void sort_into_occupied_cells(const StagedPhotons& staged, const Threads& threads);

  std::size_t count_ = 0;
  Photons photons_;  ///< and Photons::padding more elements
  Layout layout_ = Layout::dense;
  PhotonGrid grid_;
  LargeArray<std::uint32_t> cell_begin_;  ///< dense
  PhotonRows rows_;                       ///< compact
  StagedPhotons staged_;
};

}  // namespace photonproof::inline renderer_photons
