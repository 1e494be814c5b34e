// The class in rows: gradebook.csv for whoever keeps the marks, and the table that a terminal shows.
#pragma once

#include <string>

#include "reports/grades/grade_record.h"

namespace photonproof::inline reports_grades {

/// RFC 4180, a header first: name, points, correctness, speed, speed-up with its interval, a column a scene, flags and
/// the first sentence. Order of `grades`.
std::string gradebook_csv(const Grades& grades);

/// The leaderboard: rank, submission, points, scenes, speed-up, first sentence.
std::string grades_table(const Grades& grades);

/// "5 of 6"
std::string right_scenes_text(const SubmissionGrade& grade);
/// "4.02x (3.98 to 4.06)"; what became of the timing, where there is no number.
std::string speedup_text(const SpeedGrade& speed);

}  // namespace photonproof::inline reports_grades
