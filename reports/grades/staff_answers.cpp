#include "reports/grades/staff_answers.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "reports/grades/grade_words.h"
#include "reports/view/numbers.h"

namespace photonproof::reports::inline reports_grades {
namespace {

constexpr std::size_t most_parts = 6;

bool is_graded(const SceneGrade& scene) {
  return scene.verdict != SceneVerdict::unused && scene.verdict != SceneVerdict::skipped;
}

bool has_image(const SubmissionGrade& submission) {
  return submission.built && std::ranges::none_of(submission.scenes, [](const SceneGrade& scene) {
           return scene.verdict == SceneVerdict::failed;
         });
}

/// Right on every scene that was graded, by images of its own.
bool is_passed(const SubmissionGrade& submission) {
  const bool any = std::ranges::any_of(submission.scenes, is_graded);
  return any && caught_at(submission) == nullptr && std::ranges::all_of(submission.scenes, [](const SceneGrade& scene) {
           return !is_graded(scene) || scene.counts_as_right();
         });
}

void shorten(std::vector<std::string>& parts, const char* what) {
  if (parts.size() <= most_parts) return;
  const std::size_t more = parts.size() - (most_parts - 1);
  parts.resize(most_parts - 1);
  parts.push_back(fmt::format("and {} more {}", more, what));
}

StaffAnswer fastest(const Grades& grades, const std::vector<const SubmissionGrade*>& order) {
  const SubmissionGrade* best = nullptr;
  bool any_passed = false;
  for (const SubmissionGrade* submission : order) {
    if (!is_passed(*submission)) continue;
    any_passed = true;
    const SpeedGrade& speed = submission->speed;
    const bool is_timed = speed.state == SpeedGrade::State::measured || speed.state == SpeedGrade::State::too_noisy;
    if (!is_timed || speed.scenes.empty()) continue;
    if (best == nullptr || speed.speedup.value > best->speed.speedup.value) best = submission;
  }
  StaffAnswer answer{"Fastest and right", {}};
  if (best != nullptr) {
    answer.parts = {best->name + ": " + speed_words(best->speed.speedup)};
    if (best->speed.state == SpeedGrade::State::too_noisy)
      answer.parts.front() += ", too noisy for its tier to be sure";
  } else {
    answer.parts = {!any_passed               ? "nobody: no submission is right on every scene"
                    : grades.speed_points > 0 ? "not known: no right submission was timed"
                                              : "not asked: speed gives no points"};
  }
  return answer;
}

StaffAnswer passed(const Grades& grades) {
  const auto count = std::ranges::count_if(grades.submissions, is_passed);
  std::string text = fmt::format("{} of {} right on every scene", count, grades.submissions.size());
  const auto scenes = std::ranges::count_if(grades.scenes, [](const GradedScene& s) { return s.unused.empty(); });
  const auto hidden =
      std::ranges::count_if(grades.scenes, [](const GradedScene& s) { return s.unused.empty() && s.hidden; });
  if (scenes > 0) text += fmt::format(" ({} scenes, {} of them hidden)", scenes, hidden);
  return {"Passed", {text}};
}

StaffAnswer caught(const std::vector<const SubmissionGrade*>& order) {
  StaffAnswer answer{"Caught", {}, true};
  for (const SubmissionGrade* submission : order)
    if (const GradeFlag* flag = caught_at(*submission))
      answer.parts.push_back(submission->name + ": " + flag->sentence);
  shorten(answer.parts, "submissions");
  if (answer.parts.empty()) return {"Caught", {"nobody"}};
  return answer;
}

StaffAnswer to_decide(const std::vector<const SubmissionGrade*>& order) {
  StaffAnswer answer{"To decide", {}, true};
  for (const SubmissionGrade* submission : order)
    if (caught_at(*submission) == nullptr && !submission->flags.empty())
      answer.parts.push_back(submission->name + ": " + submission->flags.front().sentence);
  shorten(answer.parts, "submissions");
  return answer;
}

/// Submissions by the scenes on which they are wrong: "upside, gamma: all 5 scenes".
StaffAnswer wrong_images(const Grades& grades, const std::vector<const SubmissionGrade*>& order) {
  std::vector<std::pair<std::string, std::vector<std::string>>> groups;
  for (const SubmissionGrade* submission : order) {
    const std::string scenes = wrong_scenes_text(grades, *submission);
    if (scenes.empty() || !has_image(*submission) || caught_at(*submission) != nullptr) continue;
    const auto same = std::ranges::find(groups, scenes, [](const auto& group) { return group.first; });
    auto& names = same == groups.end() ? groups.emplace_back(scenes, std::vector<std::string>{}).second : same->second;
    names.push_back(submission->name);
  }
  StaffAnswer answer{"Wrong image", {}, true};
  for (auto& [scenes, names] : groups) {
    shorten(names, "submissions");
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
    const bool is_one = scenes.find(',') == std::string::npos && !scenes.starts_with("all ");
    answer.parts.push_back(text +
                           (scenes.starts_with("all ") ? ": on "
                            : is_one                   ? ": on scene "
                                                       : ": on scenes ") +
                           scenes + (scenes.starts_with("all ") ? " scenes" : ""));
  }
  shorten(answer.parts, "groups");
  if (answer.parts.empty()) return {"Wrong image", {"nobody’s"}};
  return answer;
}

StaffAnswer no_images(const std::vector<const SubmissionGrade*>& order) {
  StaffAnswer answer{"No image", {}, true};
  for (const SubmissionGrade* submission : order) {
    if (has_image(*submission)) continue;
    std::string why = "does not build";
    for (const SceneGrade& scene : submission->scenes)
      if (submission->built && scene.verdict == SceneVerdict::failed) why = verdict_words(scene);
    answer.parts.push_back(fmt::format("{} ({})", submission->name, why));
  }
  shorten(answer.parts, "submissions");
  std::string text;
  for (const std::string& part : answer.parts) text += (text.empty() ? "" : ", ") + part;
  if (!text.empty()) answer.parts = {text};
  return answer;
}

}  // namespace

std::string wrong_scenes_text(const Grades& grades, const SubmissionGrade& submission) {
  std::string names;
  std::size_t wrong = 0, graded = 0;
  for (const GradedScene& scene : grades.scenes) {
    const SceneGrade* grade = submission.scene(scene.name);
    if (grade == nullptr || !is_graded(*grade)) continue;
    ++graded;
    if (grade->counts_as_right()) continue;
    ++wrong;
    names += (names.empty() ? "" : ", ") + scene.name;
  }
  return wrong > 1 && wrong == graded ? fmt::format("all {}", graded) : names;
}

std::vector<StaffAnswer> staff_answers(const Grades& grades) {
  const std::vector<const SubmissionGrade*> order = leaderboard(grades);
  std::vector<StaffAnswer> answers{fastest(grades, order),      passed(grades),  caught(order), to_decide(order),
                                   wrong_images(grades, order), no_images(order)};
  if (grades.speed_points > 0)
    answers.push_back({"Clock", {"wall-clock time with all cores, in turns with the baseline"}});
  std::erase_if(answers, [](const StaffAnswer& answer) { return answer.parts.empty(); });
  return answers;
}

}  // namespace photonproof::reports::inline reports_grades
