// The error map of LDR-FLIP (metric_flip_map.cpp) and its pooled values (metric_flip_pool.cpp).
#pragma once

#include <cstdint>
#include <cstdlib>
#include <memory>
#include <vector>

#include "harness/pixels/pair_tile.h"
#include "harness/pixels/pixel_loops.h"

namespace photonproof::inline harness_metrics {

/// Viewing distance of NVIDIA's tool: 0.7 m from a screen 0.7 m and 3840 pixels wide, 3840 pi / 180 pixels a degree.
inline constexpr double flip_pixels_per_degree = 67.02064327658225;

/// FLIP of each pixel of a tile, row by row, in steps of 1/flip_steps. The colours are linear in [0,1], with a border
/// of PairTile::reach around the tile.
void flip_errors(const TileColour& reference, const TileColour& test, std::size_t width, std::size_t height,
                 TileMemory& memory, std::uint32_t* steps);

/// The frequency of each error. Sums of steps are exact, so neither order nor threads change the result. An image of
/// few pixels is a list of their steps, sorted once; a larger one has a count for each step. Both give the same bits.
class FlipPool {
 public:
  static constexpr std::uint64_t most_listed = std::uint64_t{1} << 15;  ///< pixels

  /// `pixels`: the most pixels that will be added.
  explicit FlipPool(std::uint64_t pixels);
  /// Adds the pixels of a tile that count. Several threads may call it at once.
  void add(const PairTile& tile, const std::uint32_t* steps);

  double mean() const;
  /// The smallest error at which the running sum of the ascending errors passes `fraction` of their sum: each error is
  /// weighted by its size. It is 0 when all errors are.
  double weighted_percentile(double fraction) const;
  double greatest() const;

 private:
  struct Free {
    void operator()(std::uint32_t* counts) const { std::free(counts); }
  };
  void list(const PairTile& tile, const std::uint32_t* steps);
  void count(const PairTile& tile, const std::uint32_t* steps);
  template <class Visit>
  void ascending_list(const Visit& visit) const;
  template <class Visit>
  void ascending(const Visit& visit) const;

  mutable std::vector<std::uint32_t> listed_;  // a step a pixel, the first `added_`
  std::size_t added_ = 0;
  mutable bool sorted_ = false;
  // One count a step. Most are never used, so their memory is allocated as zeros and never written. Null where steps
  // are listed.
  std::unique_ptr<std::uint32_t[], Free> counts_;
  std::vector<std::uint32_t> group_used_;  // whether any of the steps of a group occurs
};

}  // namespace photonproof::inline harness_metrics
