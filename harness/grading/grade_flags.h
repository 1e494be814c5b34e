// Findings from all images of a submission together, and of the class: copies, ignored seeds, one image for several
// scenes, right only on the public scenes.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "harness/grading/scene_grading.h"

namespace photonproof::inline harness_grading {

/// The work of one submission, by scene of the assignment; empty where the scene is not graded.
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

/// Adds flags. A copy of an image that was given out, or of the reference, makes the scene wrong. The sentence of a
/// scene whose image is another scene's names that scene. Call it before points are given.
void flag_images(const FlagContext& context, SubmissionWork& work);

/// Adds flags about the scenes that are right, once verdicts are final.
void flag_verdicts(const FlagContext& context, SubmissionWork& work);

/// Adds flags to pairs with the same noise in their images, where the baseline's image of that seed has another noise.
void flag_likenesses(const FlagContext& context, std::vector<SubmissionWork>& works);

}  // namespace photonproof::inline harness_grading
