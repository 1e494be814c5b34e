// The record of a grading as JSON: all of grades.json, and the parts that are kept during the grading.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "reports/grades/grade_record.h"

namespace photonproof::inline reports_grades {

nlohmann::ordered_json run_to_json(const GradedRun& run);
/// Throws InputError if the JSON is not a run.
GradedRun run_from_json(const nlohmann::ordered_json& json);

/// Throws std::logic_error on a number that is not finite.
nlohmann::ordered_json grades_to_json(const Grades& grades);
/// Throws InputError, naming `file`, if the JSON is no such document.
Grades grades_from_json(const nlohmann::ordered_json& json, const std::string& file);

}  // namespace photonproof::inline reports_grades
