// Sorts a batch of gathers so that neighbours follow each other: their common photons are then still in the cache.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/core/radix_sort.h"
#include "renderer/photons/photon_map.h"

namespace photonproof::inline renderer_photons {

/// The points' numbers in the order of the map's cells; points of one cell keep their order. points[i] has a finite
/// `p`.
template <class Points>
std::vector<std::uint32_t> cell_order(const PhotonMap& map, const Points& points) {
  RadixSort sort;
  sort.items.resize(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) sort.items[i] = {map.cell_order_key(points[i].p), i};
  sort.sort();
  std::vector<std::uint32_t> order(points.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = sort.items[i].index;
  return order;
}

}  // namespace photonproof::inline renderer_photons
