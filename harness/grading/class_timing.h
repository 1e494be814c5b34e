// Times the class: selects the submissions, checks their images during timing, and keeps the rounds.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "harness/grading/grade_flags.h"
#include "harness/grading/speed_rounds.h"

namespace photonproof::inline harness_grading {

struct ClassTiming {
  const Assignment& assignment;
  const std::vector<WorkScene>& scenes;
  const std::vector<std::optional<SceneReference>>& references;
  const PreparedSubmission& baseline;
  const SubmissionWork& baseline_work;
  GradeRuns& runs;
  std::filesystem::path folder;
  int cores = 1;
  bool resume = false;
  std::function<void(const std::string&)> progress;
};

/// Sets grade.speed of all. Submissions that are right on every timed scene are timed; the others get the reason. Flags
/// "fast-on-timed-only" where half of the speed-up, by the logarithm, is missing on a scene that is not timed.
void time_class(const ClassTiming& timing, const std::vector<PreparedSubmission>& prepared,
                std::vector<SubmissionWork>& works);

}  // namespace photonproof::inline harness_grading
