#include "harness/grading/grade_points.h"

#include <fmt/format.h>

#include <algorithm>

namespace photonproof::inline harness_grading {
namespace {

// Flags that explain more than the first scene where they show.
bool is_telling(const GradeFlag& flag) {
  return flag.kind == "copy-of-given" || flag.kind == "copy-of-reference" || flag.kind == "same-image" ||
         flag.kind == "copies-found" || flag.kind == "parameters-ignored" || flag.kind == "right-on-public-only" ||
         flag.kind == "fast-on-timed-only";
}

}  // namespace

double scene_points(const Assignment& assignment, const std::vector<WorkScene>& scenes, const WorkScene& scene) {
  double weights = 0;
  for (const WorkScene& other : scenes)
    if (other.unused.empty()) weights += other.row.weight;
  return scene.unused.empty() && weights > 0 ? assignment.correctness_points * scene.row.weight / weights : 0;
}

void give_points(const Assignment& assignment, const std::vector<WorkScene>& scenes, SubmissionGrade& grade) {
  grade.correctness_points = 0;
  for (SceneGrade& scene : grade.scenes) {
    const auto work = std::ranges::find_if(scenes, [&](const WorkScene& one) { return one.row.name == scene.scene; });
    const double share = scene.counts_as_right() ? 1 : scene.verdict == SceneVerdict::wrong ? scene.partial : 0;
    scene.points = share > 0 ? share * scene_points(assignment, scenes, *work) : 0;
    grade.correctness_points += scene.points;
  }
  grade.sentence = first_sentence(grade);
}

std::string first_sentence(const SubmissionGrade& grade) {
  std::size_t graded = 0, skipped = 0;
  const SceneGrade* first_bad = nullptr;
  for (const SceneGrade& scene : grade.scenes) {
    if (scene.verdict == SceneVerdict::unused || scene.sentence == left_out_by_choice) continue;
    if (scene.verdict == SceneVerdict::skipped) {
      ++skipped;
      continue;
    }
    ++graded;
    if (!scene.counts_as_right() && first_bad == nullptr) first_bad = &scene;
  }
  if (graded == 0) return skipped > 0 ? "not graded: the grading was interrupted" : "no scene was graded";
  if (!grade.built) return "does not build: " + grade.build_sentence;
  const auto flag = std::ranges::find_if(grade.flags, is_telling);
  if (flag != grade.flags.end()) {
    const bool has_reason =
        flag->kind == "right-on-public-only" && first_bad != nullptr && !first_bad->findings.empty();
    return flag->sentence +
           (has_reason ? " (" + first_bad->scene + ": " + first_bad->findings.front().sentence + ")" : "");
  }
  if (first_bad != nullptr)
    return "scene " + first_bad->scene + ": " +
           (first_bad->findings.empty() ? first_bad->sentence : first_bad->findings.front().sentence);
  if (grade.speed.state == SpeedGrade::State::changed) return grade.speed.sentence;
  if (skipped > 0)
    return fmt::format("right on {} of {} scenes when the grading was interrupted", graded, graded + skipped);
  std::string text = fmt::format("right on all {} scenes", graded);
  if (graded == 1) text = "right on the one scene";
  return grade.speed.scenes.empty() ? text : text + "; " + grade.speed.sentence;
}

}  // namespace photonproof::inline harness_grading
