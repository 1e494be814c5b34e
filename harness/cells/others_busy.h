// What others make of the machine meanwhile: measurements beside other work are worth less, and limits on time mean
// less of the processor.
#pragma once

#include <optional>

#include "scenes/base/timer.h"

namespace photonproof::inline harness_cells {

/// From its construction on. Right while no process of ours that was started before still runs.
class OthersBusy {
 public:
  OthersBusy();

  /// Cores that others used on average; 0 where that is not known, or after less time than the system's clock of
  /// processor time, of 10 ms ticks, needs to say something.
  double cores() const;

 private:
  std::optional<double> machine_;
  double ours_;
  Timer timer_;
};

/// The factor by which a limit on wall time grows beside other work, so that a program gets the processor time that an
/// idle machine would give it. It is 1 while others use less than a quarter of the machine, and 20 at most. A thread
/// that is always ready to run gets at least what others leave of a core. A program that sleeps uses less, and gains in
/// proportion to `own_cores`, the processor seconds it had a second.
double time_beside_others(double others_cores, double own_cores, int cores);

/// The same factor for a program that ended just now, on this machine. It used `cpu_seconds` within `wall_seconds`.
double time_beside_others(const OthersBusy& others, double cpu_seconds, double wall_seconds);

}  // namespace photonproof::inline harness_cells
