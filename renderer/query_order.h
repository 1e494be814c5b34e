// Sorts a batch of look-ups so that neighbours follow each other: the photons they share are then still in the cache.
#pragma once

#include <cstdint>
#include <span>

#include "renderer/photon_map.h"
#include "renderer/radix_sort.h"

namespace photonproof {

/// Keeps its memory from batch to batch; one for each thread.
class QueryOrder {
 public:
  /// Calls visit(i) for every query in the order of the map's cells; queries of one cell keep their order. The spans
  /// have one size, and hold world positions.
  template <class Visit>
  void for_each(const PhotonMap& map, std::span<const float> x, std::span<const float> y, std::span<const float> z,
                Visit&& visit) {
    sort_.items.resize(x.size());
    for (std::uint32_t i = 0; i < x.size(); ++i) sort_.items[i] = {map.cell_order_key({x[i], y[i], z[i]}), i};
    sort_.sort();
    for (const RadixSort::Item& item : sort_.items) visit(item.index);
  }

 private:
  RadixSort sort_;
};

}  // namespace photonproof
