// Is the image of a scene right? Decided from the images that there are so far; or more are asked for, with other
// seeds. The rules are fixed, so that grading again gives the same verdict:
//
// - A metric's value is its mean over the images. One image decides where it is not near the bound, that is, not within
//   a quarter of the bound (of 1 - bound, for what is at most 1, and of 20 for decibels). Else images are added until
//   the 99 % interval of the mean (Student's t) lies on one side; images that are all alike, as a program without
//   random numbers gives them, have no noise, and the value itself decides.
// - Blocks of 8 x 8 pixels are judged by gates' statistics (judge_bias): wrong where one is off by more than the bound
//   for certain, given the noise of both sides, which takes two images to be known. Where noise hides it, diagnosis
//   decides (scene_findings.h).
// - When the most images an assignment pays for leave it open, the verdict is "borderline", which counts as right:
//   nothing was proven.
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
  int images = 1;      ///< whose mean it is
  double freedom = 1;  ///< degrees of freedom of the variance
  std::string text;    ///< "mean of 8 runs of the baseline"
};
/// Of one of the images that it is the mean of.
Image variance_of_one(const SceneReference& reference);

struct SceneJudgement {
  bool decided = false;  ///< false: another image may change it
  SceneVerdict verdict = SceneVerdict::borderline;
  std::string sentence;  ///< which bound is broken, and how
  std::vector<GradedCheck> checks;
};

/// Preconditions: at least one image; the reference's size, finite values. `may_draw`: there can be more images.
SceneJudgement judge_scene(const CorrectnessRule& rule, const SceneReference& reference,
                           std::span<const Image* const> images, bool may_draw);

/// The share of a scene's points, in [0, 1], that wrong images keep: by the metric's mean magnitude over them. 0
/// without a rule or images, and where the metric is undefined.
double partial_share(const CorrectnessRule& rule, const SceneReference& reference,
                     std::span<const Image* const> images);

}  // namespace photonproof::inline harness_grading
