// Decides whether the image of a scene is right, from the images so far, or requests more with other seeds. The rules
// are fixed, so that grading again gives the same verdict:
//
// * A metric's value is its mean over the images. One image decides where its value is at least a quarter of the bound
//   away from it. The quarter is of 1 - bound for minima of at most 1, and of 20 for decibels. Near values need more
//   images, until the 99 % interval of the mean (Student's t) lies on one side. Images that are all equal, as without
//   random numbers, have no noise, and the value itself decides.
// * Blocks of 8 x 8 pixels are judged by gates' statistics (judge_bias). The image is wrong where one surely deviates
//   by more than the bound, given the noise of both sides. It takes two images to estimate that noise. Where noise
//   hides an error, diagnosis decides (scene_findings.h).
// * An image still open after the assignment's maximum of images is "borderline". That counts as right: nothing was
//   proven.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "harness/grading/assignment.h"
#include "reports/grades/grade_record.h"
#include "scenes/images/image.h"

namespace photonproof::inline harness_grading {

/// A scene's reference: the mean of independent images and the variance of that mean.
struct SceneReference {
  Rendering rendering;
  int images = 1;      ///< Number of images in the mean.
  double freedom = 1;  ///< Degrees of freedom of the variance.
  std::string text;    ///< "mean of 8 runs of the baseline".
};
/// The variance of one of the images in the mean.
Image variance_of_one(const SceneReference& reference);

struct SceneJudgement {
  bool decided = false;  ///< False: another image may change it.
  SceneVerdict verdict = SceneVerdict::borderline;
  std::string sentence;  ///< The bound that is broken, and how.
  std::vector<GradedCheck> checks;
};

/// Preconditions: at least one image; the reference's size, finite values. `may_draw`: there can be more images.
SceneJudgement judge_scene(const CorrectnessRule& rule, const SceneReference& reference,
                           std::span<const Image* const> images, bool may_draw);

/// The share in [0, 1] of a scene's points that wrong images keep, by the metric's mean magnitude over them. It is 0
/// without a rule or images, and where the metric is undefined.
double partial_share(const CorrectnessRule& rule, const SceneReference& reference,
                     std::span<const Image* const> images);

}  // namespace photonproof::inline harness_grading
