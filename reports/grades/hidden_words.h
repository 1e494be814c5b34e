// Limits what students may read about a hidden scene. They may read its number in the assignment's order, verdict,
// points, values of the metrics, and the program's mistakes in sentences of a fixed list. These sentences could be
// about any scene. No text names a hidden scene, the variant's change, a place in the image, the program's output (it
// could print the scene), or the scene's contents. "The cube is missing" or "no caustic" would reveal a scene. So all
// such findings share one sentence, and so do kinds that are not on the list.
#pragma once

#include <string>
#include <vector>

#include "reports/grades/grade_record.h"

namespace photonproof::reports::inline reports_grades {

/// A submission's grade on a hidden scene, in its student's version.
struct HiddenWords {
  std::string sentence;             ///< empty if the scene is right
  std::vector<std::string> causes;  ///< likely causes, each once
};
HiddenWords hidden_words(const Grades& grades, const SubmissionGrade& submission, const SceneGrade& grade);

/// The text with "a hidden scene" in place of the name of every hidden one ("scene NAME", "hidden scene NAME").
std::string without_hidden_names(const Grades& grades, const std::string& text);

/// The submission without names of hidden scenes in its sentences about public scenes and speed.
SubmissionGrade as_students_read(const Grades& grades, SubmissionGrade submission);

}  // namespace photonproof::reports::inline reports_grades
