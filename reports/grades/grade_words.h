// Texts on the pages of a grading. What students may read about hidden scenes is in hidden_words.h.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reports/grades/grade_record.h"

namespace photonproof::reports::inline reports_grades {

/// "12.5", "40": at most two decimals.
std::string points_text(double points);
/// "12.3×"; with its interval, "12.3× [11.9, 12.7]".
std::string speed_text(double ratio);
std::string speed_text(const Estimate& ratio);
/// "12.3 times as fast as the baseline (11.9 to 12.7)"
std::string speed_words(const Estimate& ratio);

/// CSS class of a verdict: green only for right.
const char* verdict_class(SceneVerdict verdict);
/// Symbol that shows the verdict without its colour.
const char* verdict_symbol(SceneVerdict verdict);
/// "right", "wrong", or the reason why there is no image: "crash".
std::string verdict_words(const SceneGrade& grade);

/// "scene 1"; for a hidden scene "hidden scene 2", its number among the hidden ones, counted from 1.
std::string student_title(const Grades& grades, const GradedScene& scene);
/// "scene 1", "hidden scene rigid-1": with its name.
std::string staff_title(const GradedScene& scene);

/// "whole image", "12 × 8 pixels at the lower left (columns 3 to 14, rows 80 to 87)".
std::string place_text(const GradedFinding& finding, const GradedScene& scene);
bool is_whole_image(const GradedFinding& finding, const GradedScene& scene);

/// "right on 2 of 3 scenes and on 1 of 4 hidden ones"
std::string correctness_words(const Grades& grades, const SubmissionGrade& submission);
/// The tier that was reached, and the requirement of the next one. Empty if speed gives no points.
std::string tier_words(const Grades& grades, const SpeedGrade& speed);

/// Lines of a program's output, safe to show in <pre>: the last ones of many, and long ones shortened.
std::string log_text(const std::string& log);

}  // namespace photonproof::reports::inline reports_grades
