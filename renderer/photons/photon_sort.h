// First half of the photon map's build, a counting sort in two levels. The first level partitions photons into buckets
// of neighbouring cells, in parallel over fixed chunks. The second, in the map, sorts buckets that fit a cache. Both
// keep photons of one cell in the order of their input, so the result is the same at any number of threads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "renderer/core/parallel.h"
#include "renderer/photons/photon_grid.h"
#include "renderer/photons/photons.h"

namespace photonproof::inline renderer_photons {

/// A photon on its way through the sort; unlike Photon it costs nothing to create.
using StagedPhoton = PhotonColumns<OneValue>;

struct StagedPhotons {
  int shift = 0;                     ///< a cell belongs to bucket PhotonGrid::key >> shift
  std::vector<std::uint32_t> begin;  ///< first photon of each bucket, one past the last
  LargeArray<StagedPhoton> photons;
  LargeArray<std::uint16_t> bucket_of;  ///< of each photon of the input

  std::size_t buckets() const { return begin.size() - 1; }
};

/// Refills `staged`, whose memory is reused.
void stage_by_bucket(const Photons& photons, const PhotonGrid& grid, const Threads& threads, StagedPhotons& staged);

struct Bounds {
  Vec3f low, high;
};
/// The bounding box of the photons; there must be at least one.
Bounds bounds_of(const Photons& photons, const Threads& threads);

}  // namespace photonproof::inline renderer_photons
