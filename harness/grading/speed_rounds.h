// Times submissions against the baseline, one process at a time. A round runs the baseline once a scene, next to every
// undecided submission; fast ones run several times. A slow baseline thus costs one run a round, not one a submission.
// Rounds turn their order: baseline first, then last. Images are checked during timing, too.
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
  std::string problem;  ///< Why it failed, or how its image differs from the earlier one; empty: fine.
  bool interrupted = false;
};

struct SpeedSession {
  PerformanceRule rule;
  std::vector<std::string> scenes;  ///< The timed scenes.
  std::size_t submissions = 0;
  int cores = 1;
  /// Runs a submission, or the baseline where empty, on a scene; `number` counts its runs.
  std::function<TimedRun(std::optional<std::size_t> submission, std::size_t scene, std::size_t number)> run;
  /// Called with a finished round, by submission; empty for one without a part in it. The caller keeps it.
  std::function<void(const std::vector<std::optional<SpeedRound>>&)> keep;
  std::vector<std::vector<std::optional<SpeedRound>>> kept;  ///< Rounds of an interrupted session.
  std::function<void(const std::string&)> progress;
};

/// One grade a submission. Ends early, with the results so far, when a run reports an interruption.
std::vector<SpeedGrade> time_submissions(const SpeedSession& session);

}  // namespace photonproof::inline harness_grading
