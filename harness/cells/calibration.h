// A fixed piece of work whose time tells how fast this machine is at the moment. Sessions are told apart by it: a time
// divided by that of the calibration beside it is about the same on a machine that slowed down (stored_changes.h).
//
// The work is that of a ray tracer, so that it suffers from what engines suffer from: rays through a hierarchy of boxes
// around 2^15 spheres, closest hit, as much comparing as computing, in 2.5 MB that no inner cache holds; as many
// threads as the engines have. It takes about 10 ms.
//
// Cells that together take less than a quarter of a second share a reading: machines keep their speed for so long.
// Cells that differ in nothing but the seed never do, since stored_changes.h takes the readings' noise from what their
// ratios scatter.
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
  /// The sum of what all rays hit, which is the same on every machine.
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

/// How often a reading repeats the workload after a cell of `engine_seconds`: as often as 0.5 % of that pays for, at
/// least once, 20 times at most.
std::size_t calibration_runs(double engine_seconds, double run_seconds);

/// Which cells end with a reading of their own; the others share the one before them.
class ReadingSchedule {
 public:
  /// Engine seconds since the last reading.
  static constexpr double longest_shared = 0.25;

  /// To be called when a cell has ended, which took `engine_seconds`.
  bool is_due(const Cell& cell, double engine_seconds);

 private:
  double since_reading_ = 0;
  std::set<std::string> sharing_;  // what the cells since then have in common with others: all but the seed
};

/// A session's readings: one before its first cell and one after each that the schedule names. A cell's is the mean of
/// the one before it and the one after it, or the one before it alone where it shares that.
class Calibration {
 public:
  explicit Calibration(int threads);
  /// To be called when a cell has ended, which took `engine_seconds`.
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
