// The files that Gradescope expects of an autograder: a results.json for each submission, and the zip that creates it.
// https://gradescope-autograders.readthedocs.io/en/latest/specs/
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "reports/grades/grade_record.h"

namespace photonproof::inline reports_grades {

/// Follows gradescope.schema.json, as tests check. One test for each scene and one for speed. Hidden scenes show their
/// verdict and score but nothing of their content. The leaderboard has points and the speed-up, if measured.
nlohmann::ordered_json gradescope_results(const Grades& grades, const SubmissionGrade& submission);

}  // namespace photonproof::inline reports_grades
