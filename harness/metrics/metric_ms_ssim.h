// The scales 2 to 5 of multi-scale structural similarity; metric_ssim.cpp has the first.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "harness/metrics/metric_pass.h"

namespace photonproof::inline harness_metrics {

/// One scale: a rolling window of the halved pair's rows, and the sums over finished rows.
class CoarseScale {
 public:
  CoarseScale(int width, int height);

  int width() const { return width_; }
  int height() const { return height_; }
  /// Makes room for rows up to `end`.
  void reserve_rows(int end);
  /// The address of row y, column x of a channel, for writing.
  double* at(std::size_t which, std::size_t channel, int x, int y);
  /// Call when rows above `ready` are written: measures the complete rows and passes them to `next` (null at the last
  /// scale).
  void advance(int ready, const ParallelLoop& loop, CoarseScale* next);

  int measured_rows() const { return measured_; }
  double mean_ssim(std::size_t channel) const { return sums_[channel] / windows(); }
  double mean_structure(std::size_t channel) const { return sums_[3 + channel] / windows(); }

 private:
  using Sums = std::array<double, 6>;
  double windows() const;
  Sums measure_tile(int x0, int y0, TileMemory& memory, CoarseScale* next);

  int width_, height_;
  int first_ = 0;     // first row of the planes
  int measured_ = 0;  // rows that the sums contain
  std::array<std::vector<double>, 6> planes_;
  Sums sums_{};
};

class CoarseScales {
 public:
  /// Whether the fifth scale has a whole window, and all pixels count.
  static bool possible(const PairFacts& pair);

  CoarseScales(int width, int height);
  void rows_begin(int begin, int end);
  /// Halves a tile of the images. Different tiles may be put at the same time.
  void put(const PairTile& tile);
  void rows_done(int y, const ParallelLoop& loop);
  /// The metric, from the mean contrast and structure of each channel at the first scale. Empty where a channel's mean
  /// is negative.
  std::optional<double> ms_ssim(const std::array<double, 3>& first_structure) const;

 private:
  int height_;
  std::vector<CoarseScale> scales_;
};

}  // namespace photonproof::inline harness_metrics
