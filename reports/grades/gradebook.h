// The class as rows: gradebook.csv for the marks, and the table for a terminal.
#pragma once

#include <string>

#include "reports/grades/grade_record.h"

namespace photonproof::inline reports_grades {

/// RFC 4180 with a header: name, points, correctness, speed, speed-up with its interval, one column per scene, flags
/// and the first sentence. In the order of `grades`.
std::string gradebook_csv(const Grades& grades);

/// The leaderboard: rank, submission, points, scenes, speed-up, first sentence.
std::string grades_table(const Grades& grades);

/// "5 of 6"
std::string right_scenes_text(const SubmissionGrade& grade);
/// "4.02x (3.98 to 4.06)"; without a number, the outcome of the timing.
std::string speedup_text(const SpeedGrade& speed);

}  // namespace photonproof::inline reports_grades
