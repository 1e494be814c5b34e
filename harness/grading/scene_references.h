// The references of scenes. Each is the mean of independent renders by the baseline or by one of our engines, with the
// variance of that mean, or a file from staff.
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
  OwnEngine engine;   ///< for references by an engine
  int processes = 1;  ///< number of processes at once
  std::uint64_t seed = 1;
  bool reuse = true;
  std::function<void(const std::string&)> progress;
};

/// One reference a scene; none for unused scenes. Empty when interrupted. Throws InputError where a reference cannot be
/// made: grading needs it.
std::optional<std::vector<std::optional<SceneReference>>> make_scene_references(const ReferenceWork& work);

}  // namespace photonproof::inline harness_grading
