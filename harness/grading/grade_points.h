// Points, and the first sentence about a submission.
#pragma once

#include "harness/grading/assignment.h"
#include "harness/grading/work_scenes.h"
#include "reports/grades/grade_record.h"

namespace photonproof::inline harness_grading {

/// Of a scene: its share of the points for correctness, by weight among those that are used.
double scene_points(const Assignment& assignment, const std::vector<WorkScene>& scenes, const WorkScene& scene);

/// Fills points of scenes and in all, once verdicts and speed are known.
void give_points(const Assignment& assignment, const std::vector<WorkScene>& scenes, SubmissionGrade& grade);

/// "does not build: ...", what was copied, the first scene that is not right, or how fast it is.
std::string first_sentence(const SubmissionGrade& grade);

}  // namespace photonproof::inline harness_grading
