// What others make of the machine meanwhile: measurements beside other work are worth less, and limits on time mean
// less of the processor.
#pragma once

#include <optional>

#include "scenes/text/timer.h"

namespace photonproof {

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

/// By how much a limit on wall time must grow so that a program gets what it would have of an idle machine of so many
/// cores: 1 while others use less than a quarter of it, 20 at most.
double time_beside_others(double others_cores, int cores);

}  // namespace photonproof
