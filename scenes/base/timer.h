// Wall time of a run and of its phases, by a clock that cannot be set.
#pragma once

#include <chrono>

namespace photonproof::inline scenes_base {

class Timer {
 public:
  /// Seconds since construction.
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Adds the scope's duration to a phase.
class PhaseTimer {
 public:
  explicit PhaseTimer(double& total) : total_(total) {}
  ~PhaseTimer() { total_ += timer_.seconds(); }
  PhaseTimer(const PhaseTimer&) = delete;
  PhaseTimer& operator=(const PhaseTimer&) = delete;

 private:
  double& total_;
  Timer timer_;
};

}  // namespace photonproof::inline scenes_base
