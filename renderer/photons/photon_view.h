// A photon map as plain pointers for gathers, valid while the map lives. Nothing here is emitted out of line
// (always_inline.h), so kernels for several instruction sets can include it.
#pragma once

#include <cstddef>
#include <cstdint>

#include "renderer/lanes/always_inline.h"
#include "renderer/photons/photon_grid.h"
#include "renderer/photons/photon_rows.h"
#include "renderer/photons/photons.h"

namespace photonproof::inline renderer_photons {

/// Photons in the order of PhotonGrid::key, within a cell in the order of the map's input. Arrays may be read up to
/// Photons::padding elements past the last photon.
struct PhotonView : PhotonColumns<ConstPointer> {
  std::size_t count = 0;

  PhotonGrid grid;
  const std::uint32_t* cell_begin = nullptr;  ///< dense grid: first photon of each cell, one past the last; else null
  PhotonRowsView rows{};                      ///< where the grid is not dense

  /// Calls visit(begin, end) for disjoint ranges of photons, ascending, that hold every photon within the radius and
  /// others near it. Finite p, radius >= 0.
  template <class Visit>
  PHOTONPROOF_ALWAYS_INLINE void for_each_run(const Vec3f& p, float radius, Visit&& visit) const {
    if (count == 0) return;
    const PhotonGrid::Range range = grid.range(p, radius);
    if (cell_begin == nullptr) {
      rows.for_each_run(grid, range, visit);
      return;
    }
    for (std::int32_t z_cell = range.low.z; z_cell <= range.high.z; ++z_cell) {
      for (std::int32_t y_cell = range.low.y; y_cell <= range.high.y; ++y_cell) {
        const std::uint32_t* row = cell_begin + grid.key({0, y_cell, z_cell});
        const std::uint32_t begin = row[range.low.x];
        const std::uint32_t end = row[range.high.x + 1];
        if (begin < end) visit(begin, end);
      }
    }
  }

  /// Squared distance as every gather evaluates it: single precision, no fused operations, x and y first.
  PHOTONPROOF_ALWAYS_INLINE float distance_squared(std::size_t i, const Vec3f& p) const {
    const float dx = x[i] - p.x, dy = y[i] - p.y, dz = z[i] - p.z;
    return dx * dx + dy * dy + dz * dz;
  }

  /// Calls visit(i) for every photon with distance_squared(i, p) <= radius * radius, ascending.
  template <class Visit>
  PHOTONPROOF_ALWAYS_INLINE void for_each_within(const Vec3f& p, float radius, Visit&& visit) const {
    const float radius2 = radius * radius;
    for_each_run(p, radius, [&](std::size_t begin, std::size_t end) PHOTONPROOF_INLINE_LAMBDA {
      for (std::size_t i = begin; i < end; ++i)
        if (distance_squared(i, p) <= radius2) visit(i);
    });
  }
};

}  // namespace photonproof::inline renderer_photons
