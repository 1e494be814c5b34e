// Where engines' processes run, as one interface. No verb knows the place: all work goes to `usual_executor`.
#pragma once

#include <string>
#include <vector>

#include "scenes/base/process.h"

namespace photonproof::inline harness_images {

/// A place that runs commands. Their files lie in folders that it shares with this program.
class Executor {
 public:
  virtual ~Executor() = default;
  /// As run_process: waits for the command's end and never throws for what it does. May be called on several threads.
  virtual ProcessOutcome run(const std::vector<std::string>& argv, const ProcessOptions& options) const = 0;
  /// How many commands of `threads` > 0 threads each keep the place busy; at least 1.
  virtual int at_once(int threads) const = 0;
};

/// Processes of this machine, as long as there is no other place.
const Executor& usual_executor();

}  // namespace photonproof::inline harness_images
