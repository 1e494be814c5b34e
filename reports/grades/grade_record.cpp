#include "reports/grades/grade_record.h"

#include <algorithm>
#include <array>
#include <utility>

#include "scenes/base/input_error.h"

namespace photonproof::inline reports_grades {
namespace {

constexpr std::array<std::pair<SceneVerdict, const char*>, 6> scene_verdicts{{{SceneVerdict::right, "right"},
                                                                              {SceneVerdict::borderline, "borderline"},
                                                                              {SceneVerdict::wrong, "wrong"},
                                                                              {SceneVerdict::failed, "failed"},
                                                                              {SceneVerdict::unused, "unused"},
                                                                              {SceneVerdict::skipped, "skipped"}}};

}  // namespace

std::string to_string(SceneVerdict verdict) {
  for (const auto& [value, name] : scene_verdicts)
    if (value == verdict) return name;
  return "unknown";
}

SceneVerdict scene_verdict_from(const std::string& name) {
  for (const auto& [value, known] : scene_verdicts)
    if (name == known) return value;
  throw InputError("verdict", "'" + name + "' is none");
}

std::string to_string(GradedCheck::Side side) {
  switch (side) {
    case GradedCheck::Side::inside:
      return "inside";
    case GradedCheck::Side::outside:
      return "outside";
    case GradedCheck::Side::undecided:
      break;
  }
  return "undecided";
}

std::string to_string(SpeedGrade::State state) {
  switch (state) {
    case SpeedGrade::State::none:
      return "not measured";
    case SpeedGrade::State::not_right:
      return "not right";
    case SpeedGrade::State::measured:
      return "measured";
    case SpeedGrade::State::too_noisy:
      return "too noisy";
    case SpeedGrade::State::changed:
      break;
  }
  return "other images when timed";
}

const SceneGrade* SubmissionGrade::scene(const std::string& scene_name) const {
  const auto found = std::ranges::find(scenes, scene_name, &SceneGrade::scene);
  return found == scenes.end() ? nullptr : &*found;
}

std::vector<const SubmissionGrade*> leaderboard(const Grades& grades) {
  std::vector<const SubmissionGrade*> order;
  for (const SubmissionGrade& submission : grades.submissions) order.push_back(&submission);
  std::ranges::stable_sort(order, [](const SubmissionGrade* a, const SubmissionGrade* b) {
    if (a->points() != b->points()) return a->points() > b->points();
    const double speed_a = a->speed.scenes.empty() ? 0 : a->speed.speedup.value;
    const double speed_b = b->speed.scenes.empty() ? 0 : b->speed.speedup.value;
    return speed_a != speed_b ? speed_a > speed_b : a->name < b->name;
  });
  return order;
}

}  // namespace photonproof::inline reports_grades
