// Other programs' use of the machine during a measurement: it makes measurements less reliable and leaves less
// processor time within a limit on wall time.
#pragma once

#include <optional>

#include "scenes/base/timer.h"

namespace photonproof::inline harness_cells {

/// Measures from its construction on. Correct only while no process of ours that started before is still running.
class OthersBusy {
 public:
  OthersBusy();

  /// Cores that others used on average. It is 0 where that is not known, or when too little time has passed for the
  /// system's clock of processor time, which ticks every 10 ms.
  double cores() const;

 private:
  std::optional<double> machine_;
  double ours_;
  Timer timer_;
};

/// The factor by which a limit on wall time grows beside other work, so that a program gets the processor time that an
/// idle machine would give it. It is 1 while others use less than a quarter of the machine, and 20 at most. A thread
/// that is always ready to run gets at least the share of a core that others leave. A program that sleeps uses less and
/// gains in proportion to `own_cores`, its processor seconds per second.
double time_beside_others(double others_cores, double own_cores, int cores);

/// The same factor for a program that ended just now, on this machine. It used `cpu_seconds` within `wall_seconds`.
double time_beside_others(const OthersBusy& others, double cpu_seconds, double wall_seconds);

}  // namespace photonproof::inline harness_cells
