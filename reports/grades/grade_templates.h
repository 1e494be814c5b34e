// The files of reports/templates/ for the pages of a grading, compiled in (see embed_templates.cmake).
#pragma once

#include <string_view>

namespace photonproof::reports::grade_templates {

extern const std::string_view grade_student, grade_staff, grade_scene, grade_speed, grade_build, grade_style;
/// All of their *.js as one function, and its SHA-256 in hexadecimal.
extern const std::string_view script, script_sha256;

}  // namespace photonproof::reports::grade_templates
