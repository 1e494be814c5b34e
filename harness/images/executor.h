// Interface to the place where engines' processes run. No verb depends on the place: all work goes to `usual_executor`.
#pragma once

#include <string>
#include <vector>

#include "scenes/base/process.h"

namespace photonproof::inline harness_images {

/// A place that runs commands. Their files lie in folders that it shares with this program.
class Executor {
 public:
  virtual ~Executor() = default;
  /// As run_process: waits for the command's end and never throws because of its failure. May be called on several
  /// threads.
  virtual ProcessOutcome run(const std::vector<std::string>& argv, const ProcessOptions& options) const = 0;
  /// Number of commands with `threads` > 0 threads each that keep the place busy; at least 1.
  virtual int at_once(int threads) const = 0;
};

/// Runs processes on this machine, the only place so far.
const Executor& usual_executor();

}  // namespace photonproof::inline harness_images
