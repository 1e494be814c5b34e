// How much students may read of hidden scenes: of each its number in the assignment's order, the verdict, points and
// values of the metrics, and what their program does wrong, in words of a fixed list. What these words say could be
// said of any scene. Nothing names a hidden scene, what the variant changes, a place in the image, what the program
// printed (it could print the scene), or what the scene holds: "the cube is missing" or "no caustic" gives a scene
// away, so that all such findings share one sentence. A kind of finding that is not on the list has that sentence, too.
#pragma once

#include <string>
#include <vector>

#include "reports/grades/grade_record.h"

namespace photonproof::reports::inline reports_grades {

/// A submission's grade on a hidden scene, as its student may read it.
struct HiddenWords {
  std::string sentence;             ///< empty where it is right
  std::vector<std::string> causes;  ///< likely ones, each once
};
HiddenWords hidden_words(const Grades& grades, const SubmissionGrade& submission, const SceneGrade& grade);

/// The text with "a hidden scene" in place of "scene NAME" and "hidden scene NAME" of every hidden one.
std::string without_hidden_names(const Grades& grades, const std::string& text);

/// The submission whose sentences about public scenes and speed name no hidden scene.
SubmissionGrade as_students_read(const Grades& grades, SubmissionGrade submission);

}  // namespace photonproof::reports::inline reports_grades
