// The answers on top of the staff's page: the fastest right submission, who passed, who was caught at what, whose image
// is wrong in which scene, and the clock.
#pragma once

#include <string>
#include <vector>

#include "reports/grades/grade_record.h"

namespace photonproof::reports::inline reports_grades {

struct StaffAnswer {
  std::string question;            ///< "Fastest and right"
  std::vector<std::string> parts;  ///< at least one; plain text, not escaped
  bool is_bad = false;             ///< about cheats and wrong images
};

/// Answers in the page's order. Each lists at most six submissions or groups and counts the others.
std::vector<StaffAnswer> staff_answers(const Grades& grades);

/// Scenes on which the submission's image is wrong or missing: "1, 2", "all 5"; empty if there is none.
std::string wrong_scenes_text(const Grades& grades, const SubmissionGrade& submission);

}  // namespace photonproof::reports::inline reports_grades
