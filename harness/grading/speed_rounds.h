// Times submissions against the baseline, one process at a time. A round runs the baseline once a scene, and every
// submission that is not decided yet next to it, quick ones several times: a slow baseline costs a run a round, not one
// a submission. Rounds turn their order: baseline first, then last. What a submission shows while it is timed is looked
// at, too.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "harness/grading/speed_judge.h"
#include "scenes/images/image.h"

namespace photonproof::inline harness_grading {

/// One timed run.
struct TimedRun {
  double seconds = 0;
  std::string problem;  ///< it failed, or its image is another than it was: how; empty: fine
  bool interrupted = false;
};

struct SpeedSession {
  PerformanceRule rule;
  std::vector<std::string> scenes;  ///< that are timed
  std::size_t submissions = 0;
  int cores = 1;
  /// Runs a submission, or the baseline where empty, on a scene; `number` counts its runs.
  std::function<TimedRun(std::optional<std::size_t> submission, std::size_t scene, std::size_t number)> run;
  /// Of a finished round, by submission; empty where it had no part. Kept by the caller.
  std::function<void(const std::vector<std::optional<SpeedRound>>&)> keep;
  std::vector<std::vector<std::optional<SpeedRound>>> kept;  ///< of an interrupted session
  std::function<void(const std::string&)> progress;
};

/// A grade a submission. Ends early, with what is known, when a run says that it was interrupted.
std::vector<SpeedGrade> time_submissions(const SpeedSession& session);

}  // namespace photonproof::inline harness_grading
