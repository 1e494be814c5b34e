#include "reports/grades/gradebook.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "reports/view/text.h"
#include "scenes/base/utf8.h"

namespace photonproof::inline reports_grades {
namespace {

void add_row(std::string& csv, const std::vector<std::string>& cells) {
  for (std::size_t i = 0; i < cells.size(); ++i) csv += (i == 0 ? "" : ",") + cells[i];
  csv += "\r\n";
}

std::string points_text(double points) { return fmt::format("{:.4g}", points); }

std::string padded(const std::string& text, std::size_t width, bool right) {
  const std::string blanks(width > text.size() ? width - text.size() : 0, ' ');
  return right ? blanks + text : text + blanks;
}

}  // namespace

std::string right_scenes_text(const SubmissionGrade& grade) {
  std::size_t right = 0, graded = 0;
  for (const SceneGrade& scene : grade.scenes) {
    if (scene.verdict == SceneVerdict::unused || scene.verdict == SceneVerdict::skipped) continue;
    ++graded;
    if (scene.counts_as_right()) ++right;
  }
  return fmt::format("{} of {}", right, graded);
}

std::string speedup_text(const SpeedGrade& speed) {
  if (speed.scenes.empty()) return to_string(speed.state);
  std::string text = fmt::format("{:.3g}x", speed.speedup.value);
  if (speed.speedup.interval)
    text += fmt::format(" ({:.3g} to {:.3g})", speed.speedup.interval->low, speed.speedup.interval->high);
  return speed.state == SpeedGrade::State::measured ? text : text + ", " + to_string(speed.state);
}

std::string gradebook_csv(const Grades& grades) {
  std::vector<std::string> header{"submission",         "points",       "max_points",
                                  "correctness_points", "speed_points", "speedup",
                                  "speedup_low",        "speedup_high", "timing"};
  for (const GradedScene& scene : grades.scenes)
    header.push_back(reports::csv_cell((scene.hidden ? "hidden " : "scene ") + scene.name));
  header.insert(header.end(), {"flags", "sentence"});
  std::string csv;
  add_row(csv, header);
  for (const SubmissionGrade& grade : grades.submissions) {
    std::vector<std::string> cells{reports::csv_cell(grade.name), points_text(grade.points()),
                                   points_text(grades.max_points()), points_text(grade.correctness_points),
                                   points_text(grade.speed.points)};
    const bool has_ratio = !grade.speed.scenes.empty();
    const auto& interval = grade.speed.speedup.interval;
    cells.push_back(has_ratio ? fmt::format("{:.4g}", grade.speed.speedup.value) : "");
    cells.push_back(has_ratio && interval ? fmt::format("{:.4g}", interval->low) : "");
    cells.push_back(has_ratio && interval ? fmt::format("{:.4g}", interval->high) : "");
    cells.push_back(to_string(grade.speed.state));
    for (const GradedScene& scene : grades.scenes) {
      const SceneGrade* found = grade.scene(scene.name);
      cells.push_back(found == nullptr ? "" : to_string(found->verdict));
    }
    std::string flags;
    for (const GradeFlag& flag : grade.flags) flags += (flags.empty() ? "" : " ") + flag.kind;
    cells.push_back(reports::csv_cell(flags));
    cells.push_back(reports::csv_cell(grade.sentence));
    add_row(csv, cells);
  }
  return csv;
}

std::string grades_table(const Grades& grades) {
  std::vector<std::array<std::string, 5>> rows{{"submission", "points", "scenes", "speed-up", "first of all"}};
  for (const SubmissionGrade* grade : leaderboard(grades)) {
    const GradeFlag* const proof = caught_at(*grade);
    rows.push_back({printable(grade->name), points_text(grade->points()) + "/" + points_text(grades.max_points()),
                    right_scenes_text(*grade), speedup_text(grade->speed),
                    printable(proof != nullptr ? "caught, no place: " + proof->sentence : grade->sentence)});
  }
  std::array<std::size_t, 4> widths{};
  for (const auto& row : rows)
    for (std::size_t c = 0; c < widths.size(); ++c) widths[c] = std::max(widths[c], row[c].size());
  std::string table;
  for (const auto& row : rows) {
    for (std::size_t c = 0; c < widths.size(); ++c) table += padded(row[c], widths[c], c == 1) + "  ";
    table += row.back() + "\n";
  }
  return table;
}

}  // namespace photonproof::inline reports_grades
