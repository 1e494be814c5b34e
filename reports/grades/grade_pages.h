// A grading as HTML: one page per submission for its student, and one for staff. Pure views of the record.
#pragma once

#include <filesystem>

#include "reports/grades/grade_record.h"

namespace photonproof::inline reports_grades {

/// A single file with the pictures of public scenes inside. It follows grade_words.h about hidden scenes, and has
/// nothing of other submissions, flags, the grading's seed or its command. Reads pictures from `folder`, which holds
/// grades.json; the page names missing ones. Throws InputError when `out` cannot be written.
void write_student_page(const Grades& grades, const SubmissionGrade& submission, const std::filesystem::path& folder,
                        const std::filesystem::path& out);

/// The whole grading, for staff only. Thumbnails are inside; larger pictures are links into `folder`, relative to
/// `out`.
void write_staff_page(const Grades& grades, const std::filesystem::path& folder, const std::filesystem::path& out);

}  // namespace photonproof::inline reports_grades
