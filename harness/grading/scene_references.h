// What images of each scene are compared with: the mean of independent renders by the baseline or by an engine of ours,
// with the variance of that mean, or a file of staff's.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "harness/grading/grade_runs.h"
#include "harness/grading/scene_judge.h"
#include "harness/variants/own_engine.h"

namespace photonproof::inline harness_grading {

struct ReferenceWork {
  const Assignment& assignment;
  const std::vector<WorkScene>& scenes;
  const PreparedSubmission& baseline;
  GradeRuns& runs;
  OwnEngine engine;   ///< where references are by one
  int processes = 1;  ///< side by side
  std::uint64_t seed = 1;
  bool reuse = true;
  std::function<void(const std::string&)> progress;
};

/// One a scene; none for scenes that are not used. Empty when interrupted. Throws InputError where a reference cannot
/// be made: without it nobody can be graded.
std::optional<std::vector<std::optional<SceneReference>>> make_scene_references(const ReferenceWork& work);

}  // namespace photonproof::inline harness_grading
