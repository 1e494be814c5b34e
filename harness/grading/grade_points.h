// Points, and the first sentence about a submission.
#pragma once

#include "harness/grading/assignment.h"
#include "harness/grading/work_scenes.h"
#include "reports/grades/grade_record.h"

namespace photonproof::inline harness_grading {

/// Points of a scene: its share of the points for correctness, by weight among the used scenes.
double scene_points(const Assignment& assignment, const std::vector<WorkScene>& scenes, const WorkScene& scene);

/// Fills in the points of scenes and their sum, once verdicts and speed are known.
void give_points(const Assignment& assignment, const std::vector<WorkScene>& scenes, SubmissionGrade& grade);

/// "does not build: ...", the copied image, the first scene that is not right, or the speed.
std::string first_sentence(const SubmissionGrade& grade);

}  // namespace photonproof::inline harness_grading
