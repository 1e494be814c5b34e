// A grading as HTML: a page a submission for its student, and one for staff. Pure views of the record.
#pragma once

#include <filesystem>

#include "reports/grades/grade_record.h"

namespace photonproof::inline reports_grades {

/// One file that needs no other: pictures of public scenes are inside. What it says of hidden scenes, and what not, is
/// in grade_words.h. Nothing of other submissions, flags, the grading's seed or its command is in it. Pictures are read
/// from `folder`, which holds grades.json; a missing one is said on the page. Throws InputError when `out` cannot be
/// written.
void write_student_page(const Grades& grades, const SubmissionGrade& submission, const std::filesystem::path& folder,
                        const std::filesystem::path& out);

/// Everything, for staff only: thumbnails are inside, larger pictures are links into `folder`, relative to `out`.
void write_staff_page(const Grades& grades, const std::filesystem::path& folder, const std::filesystem::path& out);

}  // namespace photonproof::inline reports_grades
