// The sums of a metric over the tiles of an image pair. metric_run.h drives it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "harness/metrics/metrics.h"
#include "harness/pixels/pair_tile.h"

namespace photonproof::inline harness_metrics {

/// Facts about the whole pair, known before its first row.
struct PairFacts {
  int width = 0, height = 0;
  std::uint64_t counted = 0;  ///< pixels that count: all, or those of the mask
  bool masked = false;
  MetricOptions options;
};

/// Calls body(i, memory of its thread) for i in [0, n), in any order, on the run's threads.
using TileBody = std::function<void(std::size_t, TileMemory&)>;
using ParallelLoop = std::function<void(std::size_t n, const TileBody& body)>;

/// One value a pixel of a tile, row by row, for a heat map; null without one.
struct TileMaps {
  float* flip = nullptr;
  float* error = nullptr;
};

/// The result must not depend on the order of `measure`, which threads call for different tiles at once. Everything
/// else is called from one thread.
class MetricPass {
 public:
  using Part = std::vector<double>;

  virtual ~MetricPass() = default;
  /// The tiles of image rows [begin, end) come next.
  virtual void rows_begin(int /*begin*/, int /*end*/) {}
  /// Writes a tile's part of the number into an empty vector.
  virtual void measure(const PairTile& tile, const TileMaps& maps, Part& part) = 0;
  /// Adds the part that measure() made of each tile: row by row of tiles, from left to right.
  virtual void add(const Part& part) = 0;
  /// All tiles above image row y have been added; y is a multiple of TileGrid::tile_height, or the height.
  virtual void rows_done(int /*y*/, const ParallelLoop& /*loop*/) {}
  /// The number of one row of the table; rows that share a pass differ in `which`. Empty where it is undefined.
  virtual std::optional<double> value(std::size_t which) const = 0;
};

/// A pass whose parts are sums, which it adds up.
class SumPass : public MetricPass {
 public:
  void add(const Part& part) override {
    if (sums_.size() < part.size()) sums_.resize(part.size());
    for (std::size_t i = 0; i < part.size(); ++i) sums_[i] += part[i];
  }

 protected:
  double sum(std::size_t i) const { return i < sums_.size() ? sums_[i] : 0.0; }

 private:
  std::vector<double> sums_;
};

}  // namespace photonproof::inline harness_metrics
