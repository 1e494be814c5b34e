#include "reports/grades/gradescope.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "reports/grades/grade_words.h"
#include "reports/grades/hidden_words.h"
#include "scenes/base/utf8.h"

namespace photonproof::inline reports_grades {
namespace {

using Document = nlohmann::ordered_json;

// Points rounded for readers: no 13.333333333333334 for a third of 40.
double rounded(double points) { return std::round(points * 1000) / 1000; }

double seconds_of(const SubmissionGrade& submission) {
  double seconds = submission.build_seconds;
  for (const SceneGrade& scene : submission.scenes)
    for (const GradedRun& run : scene.runs) seconds += run.wall_seconds;
  return seconds;
}

std::string scene_output(const SceneGrade& grade) {
  std::string text = to_string(grade.verdict);
  if (!grade.sentence.empty()) text += ": " + printable(grade.sentence);
  for (const GradedFinding& finding : grade.findings) {
    text += "\n- " + printable(finding.sentence);
    if (!finding.cause.empty()) text += " (" + printable(finding.cause) + ")";
  }
  return text;
}

std::string hidden_output(const Grades& grades, const SubmissionGrade& submission, const SceneGrade& grade) {
  const reports::HiddenWords words = reports::hidden_words(grades, submission, grade);
  std::string text = to_string(grade.verdict) + (words.sentence.empty() ? "" : ": " + words.sentence);
  for (const std::string& cause : words.causes) text += "\n- " + cause;
  return text;
}

Document scene_test(const Grades& grades, const SubmissionGrade& submission, const GradedScene& scene,
                    const SceneGrade& grade) {
  const bool passed = grade.counts_as_right();
  return {{"score", rounded(grade.points)},
          {"max_score", rounded(scene.max_points)},
          {"status", passed ? "passed" : "failed"},
          {"name", printable(reports::student_title(grades, scene))},
          {"output", scene.hidden ? hidden_output(grades, submission, grade) : scene_output(grade)},
          {"output_format", "text"},
          {"visibility", "visible"}};
}

Document speed_test(const Grades& grades, const SubmissionGrade& submission) {
  return {{"score", rounded(submission.speed.points)},
          {"max_score", rounded(grades.speed_points)},
          {"name", "speed: " + grades.speed_rule},
          {"output",
           submission.speed.scenes.empty() ? to_string(submission.speed.state) : printable(submission.speed.sentence)},
          {"output_format", "text"},
          {"visibility", "visible"}};
}

}  // namespace

nlohmann::ordered_json gradescope_results(const Grades& grades, const SubmissionGrade& graded) {
  const SubmissionGrade submission = reports::as_students_read(grades, graded);
  Document results = {{"score", rounded(submission.points())},
                      {"execution_time", rounded(seconds_of(submission))},
                      {"output", ""},
                      {"output_format", "text"},
                      {"stdout_visibility", "hidden"},
                      {"tests", Document::array()},
                      {"leaderboard", Document::array()}};
  if (!submission.built) results["output"] = printable("does not build: " + submission.build_sentence);
  for (const GradedScene& scene : grades.scenes) {
    const SceneGrade* grade = submission.scene(scene.name);
    if (grade == nullptr || !scene.unused.empty()) continue;
    results["tests"].push_back(scene_test(grades, submission, scene, *grade));
  }
  if (grades.speed_points > 0) results["tests"].push_back(speed_test(grades, submission));
  results["leaderboard"].push_back({{"name", "points"}, {"value", rounded(submission.points())}});
  const bool has_speed = !submission.speed.scenes.empty() && submission.speed.state != SpeedGrade::State::changed;
  if (has_speed)
    results["leaderboard"].push_back(
        {{"name", "speed-up"}, {"value", std::round(submission.speed.speedup.value * 100) / 100}});
  return results;
}

}  // namespace photonproof::inline reports_grades
