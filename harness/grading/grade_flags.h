// What the images of a submission show together, and those of the class: copies, ignored seeds, one image for several
// scenes, right on the public scenes only.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "harness/grading/scene_grading.h"

namespace photonproof::inline harness_grading {

/// Everything about one submission, by scene of the assignment; empty where the scene is not graded.
struct SubmissionWork {
  SubmissionGrade grade;
  std::vector<std::optional<SceneWorkGrade>> scenes;
  bool tried = false;  ///< its build has ended
};

struct FlagContext {
  const Assignment& assignment;
  const std::vector<WorkScene>& scenes;
  const std::vector<std::optional<SceneReference>>& references;
  const SubmissionWork& baseline;
};

/// Adds flags. A copy of an image that was given out, or of the reference, makes the scene wrong; an image that is
/// another scene's says so in the scene's sentence. To be called before points are given.
void flag_images(const FlagContext& context, SubmissionWork& work);

/// The same of which scenes are right, once that will not change any more.
void flag_verdicts(const FlagContext& context, SubmissionWork& work);

/// The same of pairs: images with the same noise, which the baseline's image of that seed does not have.
void flag_likenesses(const FlagContext& context, std::vector<SubmissionWork>& works);

}  // namespace photonproof::inline harness_grading
