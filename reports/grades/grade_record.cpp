#include "reports/grades/grade_record.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "reports/grades/grade_fields.h"

namespace photonproof::inline reports_grades {
std::string to_string(SceneVerdict verdict) { return word_of(verdict); }
std::string to_string(GradedCheck::Side side) { return word_of(side); }
std::string to_string(SpeedGrade::State state) { return word_of(state); }

const SceneGrade* SubmissionGrade::scene(const std::string& scene_name) const {
  const auto found = std::ranges::find(scenes, scene_name, &SceneGrade::scene);
  return found == scenes.end() ? nullptr : &*found;
}

const GradeFlag* caught_at(const SubmissionGrade& submission) {
  constexpr std::array<std::string_view, 5> proofs{"copy-of-given", "copy-of-reference", "keeps-results",
                                                   "copies-found", "parameters-ignored"};
  const auto has = [&submission](std::string_view kind) {
    return std::ranges::find(submission.flags, kind, &GradeFlag::kind);
  };
  for (const std::string_view kind : proofs)
    if (const auto found = has(kind); found != submission.flags.end()) return &*found;
  // A program that takes every scene for the same one is wrong on public scenes, too.
  const auto same = has("same-image"), none = submission.flags.end();
  return same != none && has("right-on-public-only") != none ? &*same : nullptr;
}

std::vector<const SubmissionGrade*> leaderboard(const Grades& grades) {
  std::vector<const SubmissionGrade*> order;
  for (const SubmissionGrade& submission : grades.submissions) order.push_back(&submission);
  std::ranges::stable_sort(order, [](const SubmissionGrade* a, const SubmissionGrade* b) {
    const bool is_caught_a = caught_at(*a) != nullptr, is_caught_b = caught_at(*b) != nullptr;
    if (is_caught_a != is_caught_b) return is_caught_b;
    if (a->points() != b->points()) return a->points() > b->points();
    const double speed_a = a->speed.scenes.empty() ? 0 : a->speed.speedup.value;
    const double speed_b = b->speed.scenes.empty() ? 0 : b->speed.speedup.value;
    return speed_a != speed_b ? speed_a > speed_b : a->name < b->name;
  });
  return order;
}

}  // namespace photonproof::inline reports_grades
