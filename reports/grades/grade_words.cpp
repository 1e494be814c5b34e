#include "reports/grades/grade_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <string_view>
#include <utility>

#include "reports/view/numbers.h"
#include "reports/view/text.h"

namespace photonproof::reports::inline reports_grades {
namespace {

bool is_a_plain_kind(const std::string& kind) {
  const auto is_plain = [](char c) { return (c >= 'a' && c <= 'z') || c == '-' || c == ' '; };
  return !kind.empty() && kind.size() <= 40 && std::ranges::all_of(kind, is_plain);
}

std::string kind_words(const std::string& kind) {
  std::string words = kind;
  std::ranges::replace(words, '-', ' ');
  return words;
}

const char* third(double middle, double length, const char* first, const char* second, const char* last) {
  return middle < length / 3 ? first : middle < 2 * length / 3 ? second : last;
}

std::string range_words(const char* what, int first, int count) {
  return count == 1 ? fmt::format("{} {}", what, first) : fmt::format("{}s {} to {}", what, first, first + count - 1);
}

// Tiers are round numbers.
std::string tier_ratio(double ratio) { return points_text(ratio) + "×"; }

}  // namespace

std::string points_text(double points) {
  std::string text = fixed_decimals(points, 2);
  while (text.ends_with('0') && text.find('.') != std::string::npos) text.pop_back();
  if (text.ends_with('.')) text.pop_back();
  return text;
}

std::string speed_text(double ratio) { return significant(ratio) + "×"; }

std::string speed_text(const Estimate& ratio) {
  if (!ratio.interval) return speed_text(ratio.value);
  return fmt::format("{} [{}, {}]", speed_text(ratio.value), significant(ratio.interval->low),
                     significant(ratio.interval->high));
}

std::string speed_words(const Estimate& ratio) {
  const std::string text = significant(ratio.value) + " times as fast as the baseline";
  if (!ratio.interval) return text;
  return fmt::format("{} ({} to {})", text, significant(ratio.interval->low), significant(ratio.interval->high));
}

const char* verdict_class(SceneVerdict verdict) {
  switch (verdict) {
    case SceneVerdict::right:
      return "good";
    case SceneVerdict::borderline:
      return "open";
    case SceneVerdict::wrong:
    case SceneVerdict::failed:
      return "poor";
    case SceneVerdict::unused:
    case SceneVerdict::skipped:
      break;
  }
  return "same";
}

const char* verdict_symbol(SceneVerdict verdict) {
  switch (verdict) {
    case SceneVerdict::right:
      return "✓";
    case SceneVerdict::borderline:
      return "≈";
    case SceneVerdict::wrong:
      return "≠";
    case SceneVerdict::failed:
      return "✕";
    case SceneVerdict::unused:
    case SceneVerdict::skipped:
      break;
  }
  return "–";
}

std::string verdict_words(const SceneGrade& grade) {
  if (grade.verdict == SceneVerdict::borderline) return "right within noise";
  if (grade.verdict != SceneVerdict::failed) return to_string(grade.verdict);
  for (const GradedRun& run : grade.runs)
    if (run.end != "ok" && is_a_plain_kind(run.end)) return kind_words(run.end);
  return "no image";
}

std::string student_title(const Grades& grades, const GradedScene& scene) {
  if (!scene.hidden) return staff_title(scene);
  int number = 0;
  for (const GradedScene& other : grades.scenes) {
    number += other.hidden;
    if (&other == &scene || other.name == scene.name) break;
  }
  return fmt::format("hidden scene {}", number);
}

std::string staff_title(const GradedScene& scene) { return (scene.hidden ? "hidden scene " : "scene ") + scene.name; }

bool is_whole_image(const GradedFinding& finding, const GradedScene& scene) {
  return 1.0 * finding.width * finding.height >= 0.9 * scene.width * scene.height;
}

std::string place_text(const GradedFinding& finding, const GradedScene& scene) {
  if (finding.width <= 0 || finding.height <= 0) return {};
  if (is_whole_image(finding, scene)) return "whole image";
  const std::string down = third(finding.y + finding.height / 2.0, scene.height, "upper ", "", "lower ");
  const std::string across = third(finding.x + finding.width / 2.0, scene.width, "left", "middle", "right");
  const std::string where = down.empty() && across != "middle" ? "at the " + across : "in the " + down + across;
  return fmt::format("{} × {} pixels {} ({}, {})", finding.width, finding.height, where,
                     range_words("column", finding.x, finding.width), range_words("row", finding.y, finding.height));
}

std::string correctness_words(const Grades& grades, const SubmissionGrade& submission) {
  std::array<std::size_t, 2> right{}, all{};
  for (const GradedScene& scene : grades.scenes) {
    const SceneGrade* grade = submission.scene(scene.name);
    if (grade == nullptr || grade->verdict == SceneVerdict::unused || grade->verdict == SceneVerdict::skipped) continue;
    ++all[scene.hidden];
    right[scene.hidden] += grade->counts_as_right();
  }
  if (all[0] + all[1] == 0) return "no scene was graded";
  std::string text = "right on ";
  if (all[0] > 0) text += fmt::format("{} of {} public scenes", right[0], all[0]);
  if (all[0] > 0 && all[1] > 0) text += " and ";
  if (all[1] > 0) text += fmt::format("{} of {} hidden ones", right[1], all[1]);
  return text;
}

std::string tier_words(const Grades& grades, const SpeedGrade& speed) {
  if (speed.state == SpeedGrade::State::not_right) return "Speed counts once the scenes it asks for are right.";
  if (speed.scenes.empty()) return {};
  if (grades.speed_curve && speed.points < grades.speed_curve->points)
    return fmt::format("All {} points are given at {}.", points_text(grades.speed_curve->points),
                       tier_ratio(grades.speed_curve->ratio));
  const SpeedTier *reached = nullptr, *next = nullptr;
  for (const SpeedTier& tier : grades.speed_tiers) {
    if (tier.points <= speed.points + 1e-9)
      reached = &tier;
    else if (next == nullptr)
      next = &tier;
  }
  if (grades.speed_tiers.empty()) return {};
  std::string text =
      reached == nullptr ? "No tier is reached yet." : "The tier of " + tier_ratio(reached->ratio) + " is reached.";
  if (next == nullptr) return text + " There is none beyond.";
  text += fmt::format(" The next, {} for {} points", tier_ratio(next->ratio), points_text(next->points));
  const double missing = next->ratio / speed.speedup.value;
  return text + (missing > 1 ? fmt::format(", needs {} times this speed.", significant(missing)) : ".");
}

std::string log_text(const std::string& log) {
  constexpr std::size_t most_lines = 200, most_bytes = 2000;
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < log.size();) {
    const std::size_t end = std::min(log.find('\n', at), log.size());
    const std::string line = printable(std::string_view(log).substr(at, end - at));
    lines.push_back(line.size() > most_bytes ? shortened(line, most_bytes) + " …" : line);
    at = end + 1;
  }
  std::string text;
  const std::size_t first = lines.size() > most_lines ? lines.size() - most_lines : 0;
  if (first > 0) text = fmt::format("… {} lines before\n", first);
  for (std::size_t i = first; i < lines.size(); ++i) text += lines[i] + "\n";
  return text;
}

}  // namespace photonproof::reports::inline reports_grades
