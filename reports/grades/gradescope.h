// What Gradescope takes of an autograder: a results.json a submission, and the zip that makes it there.
// https://gradescope-autograders.readthedocs.io/en/latest/specs/
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "reports/grades/grade_record.h"

namespace photonproof::inline reports_grades {

/// By gradescope.schema.json, as tests check. A test a scene and one for speed; hidden scenes tell their verdict and
/// score, nothing of what they show. The leaderboard has points and, where it was measured, the speed-up.
nlohmann::ordered_json gradescope_results(const Grades& grades, const SubmissionGrade& submission);

}  // namespace photonproof::inline reports_grades
