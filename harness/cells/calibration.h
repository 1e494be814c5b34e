// Calibration: a fixed piece of work whose time shows how fast this machine is at the moment. Times of two sessions are
// compared relative to it: the ratio stays about the same on a machine that slowed down (stored_changes.h).
//
// The work resembles a ray tracer's, so that the same disturbances slow both. It finds the closest hits of rays in a
// hierarchy of boxes around 2^15 spheres, with as many threads as the engines have. It compares as much as it computes,
// in 2.5 MB that no inner cache holds. It takes about 10 ms.
//
// Cells that together take less than a quarter of a second share a reading, since machines keep their speed that long.
// Cells that differ only in the seed never share one: stored_changes.h takes the readings' noise from the scatter of
// their ratios.
#pragma once

#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "reports/record/results.h"

namespace photonproof::inline harness_cells {

class CalibrationWorkload {
 public:
  CalibrationWorkload();
  /// Sum of the indices that all rays hit; it is the same on every machine.
  std::uint64_t run() const;

 private:
  struct Box {
    float low[3], high[3];
  };
  struct Sphere {
    float center[3], radius;
  };
  std::uint32_t closest(const float (&from)[3], const float (&along)[3]) const;
  std::vector<Box> boxes_;  // a complete binary tree: the children of i are 2 i and 2 i + 1, the root is 1
  std::vector<Sphere> spheres_;
};

/// How often a reading repeats the workload after a cell of `engine_seconds`: as often as fits into 0.5 % of that time,
/// at least once and at most 20 times.
std::size_t calibration_runs(double engine_seconds, double run_seconds);

/// Decides which cells end with a reading of their own; the others share the one before them.
class ReadingSchedule {
 public:
  /// Engine seconds since the last reading.
  static constexpr double longest_shared = 0.25;

  /// To be called when a cell has ended that took `engine_seconds`.
  bool is_due(const Cell& cell, double engine_seconds);

 private:
  double since_reading_ = 0;
  std::set<std::string> sharing_;  // labels, without the seed, of the cells since then
};

/// Readings of a session: one before its first cell and one after each cell that the schedule names. A cell's value is
/// the mean of the readings before and after it, or the one before it if the cell shares that.
class Calibration {
 public:
  explicit Calibration(int threads);
  /// To be called when a cell has ended that took `engine_seconds`.
  CalibrationReading after_cell(const Cell& cell, double engine_seconds);

 private:
  double read(std::size_t runs) const;
  CalibrationWorkload workload_;
  ReadingSchedule schedule_;
  int threads_;
  double run_seconds_ = 0;  // wall time of one run
  double last_ = 0;         // reading
};

}  // namespace photonproof::inline harness_cells
