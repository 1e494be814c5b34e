#include <fmt/format.h>

#include <algorithm>

#include "reports/grades/flag_words.h"
#include "reports/grades/grade_data.h"
#include "reports/grades/grade_pages.h"
#include "reports/grades/grade_plots.h"
#include "reports/grades/grade_templates.h"
#include "reports/grades/grade_words.h"
#include "reports/grades/likeness_groups.h"
#include "reports/grades/staff_answers.h"
#include "reports/page/html_data.h"
#include "reports/page/page_parts.h"
#include "reports/page/picture.h"
#include "reports/view/environment.h"
#include "reports/view/results_file.h"
#include "reports/view/text.h"
#include "reports/view/view.h"
#include "scenes/files/atomic_file.h"

namespace photonproof::reports::inline reports_grades {
namespace {

using kainjow::mustache::data;
namespace fs = std::filesystem;

constexpr int thumbnail_side = 48;

std::string submission_id(std::size_t place) { return fmt::format("s{}", place + 1); }
std::string block_id(std::size_t place, std::size_t scene) { return fmt::format("s{}-{}", place + 1, scene + 1); }

/// Pictures that stay in place, as links from the page's folder.
class LinkedPictures {
 public:
  LinkedPictures(const fs::path& folder, const fs::path& out)
      : folder_(folder), from_(fs::absolute(out).lexically_normal().parent_path()) {}

  PagePicture operator()(const GradedScene& scene, const std::string& relative) const {
    const ResultsFile found = results_file(folder_, relative);
    if (!found.problem.empty()) return {{}, found.problem, 0, 0, {}};
    const fs::path path = (fs::absolute(folder_) / relative).lexically_normal().lexically_relative(from_);
    const std::string address = url_path(path.generic_string());
    return {address, {}, scene.width, scene.height, address};
  }

 private:
  fs::path folder_, from_;
};

void set_thumbnail(data& cell, const fs::path& folder, const std::string& file, const std::string& alt) {
  const EmbeddedPicture picture = file.empty() ? EmbeddedPicture{{}, 0, 0, "no picture was made", false}
                                               : embed_thumbnail(folder, file, thumbnail_side);
  cell.set("has_picture", picture.problem.empty());
  cell.set("address", picture.uri);
  cell.set("alt", printable(alt));
}

data column_data(const GradedScene& scene, const fs::path& folder) {
  data column;
  set_thumbnail(column, folder, scene.reference_picture, "reference of " + staff_title(scene));
  column.set("title", printable(scene.name));
  column.set("hidden", scene.hidden);
  return column;
}

data cell_data(const GradedScene& scene, const SceneGrade* grade, const fs::path& folder, const std::string& id) {
  const SceneGrade none;
  const SceneGrade& shown = grade == nullptr ? none : *grade;
  data cell;
  set_thumbnail(cell, folder, picture_file(shown.pictures, "image"), staff_title(scene) + ": " + verdict_words(shown));
  cell.set("anchor", grade == nullptr ? data(false) : data(id));
  cell.set("class", verdict_class(shown.verdict));
  cell.set("symbol", verdict_symbol(shown.verdict));
  return cell;
}

data text_list(const std::vector<std::string>& texts) {
  data list(data::type::list);
  for (const std::string& text : texts) list.push_back(printable(text));
  return list;
}

/// The reason for a row without a speed-up, in words.
const char* untimed_text(SpeedGrade::State state) {
  switch (state) {
    case SpeedGrade::State::not_right:
      return "wrong, so not timed";
    case SpeedGrade::State::changed:
      return "images changed while timed";
    case SpeedGrade::State::none:
    case SpeedGrade::State::measured:
    case SpeedGrade::State::too_noisy:
      break;
  }
  return "not timed";
}

/// A submission's kinds of flags, each once.
data flag_list(const SubmissionGrade& submission) {
  data list(data::type::list);
  std::vector<std::string> kinds;
  for (const GradeFlag& flag : submission.flags) {
    if (std::ranges::find(kinds, flag.kind) != kinds.end()) continue;
    data item;
    item.set("comma", !kinds.empty());
    item.set("kind", printable(flag_name(flag.kind)));
    item.set("meaning", printable(flag_meaning(flag.kind)));
    list.push_back(item);
    kinds.push_back(flag.kind);
  }
  return list;
}

/// Place, and the sentence beside it. A submission that was caught has no place.
void set_place(data& row, const SubmissionGrade& submission, std::size_t place) {
  const GradeFlag* const proof = caught_at(submission);
  const bool is_open = proof == nullptr && !submission.flags.empty();
  row.set("place", std::to_string(place + 1));
  row.set("caught", proof != nullptr);
  row.set("open", is_open);
  row.set("told", printable(submission.sentence));
  row.set("why", proof != nullptr ? printable(proof->sentence)
                 : is_open        ? printable(submission.flags.front().sentence)
                                  : printable(submission.sentence));
}

void set_row_numbers(data& row, const SubmissionGrade& submission) {
  std::size_t graded = 0, right = 0;
  for (const SceneGrade& scene : submission.scenes) {
    if (scene.verdict == SceneVerdict::unused || scene.verdict == SceneVerdict::skipped) continue;
    ++graded;
    right += scene.counts_as_right();
  }
  const bool has_speed = !submission.speed.scenes.empty();
  row.set("points", points_text(submission.points()));
  row.set("correctness", points_text(submission.correctness_points));
  row.set("speed_points", points_text(submission.speed.points));
  row.set("speedup", has_speed ? data(speed_text(submission.speed.speedup)) : data(false));
  row.set("untimed", untimed_text(submission.speed.state));
  row.set("untimed_why", printable(submission.speed.sentence));
  row.set("speed_sort", has_speed ? fmt::format("{}", submission.speed.speedup.value) : "");
  row.set("noisy", submission.speed.state == SpeedGrade::State::too_noisy);
  row.set("right", std::to_string(right));
  row.set("graded", std::to_string(graded));
  row.set("flag_count", std::to_string(submission.flags.size()));
  row.set("row_flags", flag_list(submission));
}

/// All values for one submission: its rows of the leaderboard and of the matrix, and its own section.
data submission_row(const Grades& grades, const SubmissionGrade& submission, std::size_t place, const fs::path& folder,
                    const LinkedPictures& pictures) {
  data row, cells(data::type::list), scenes(data::type::list), flags(data::type::list);
  set_place(row, submission, place);
  row.set("id", submission_id(place));
  row.set("name", printable(submission.name));
  row.set("source", printable(submission.source));
  row.set("wrong_on", text_or_false(wrong_scenes_text(grades, submission)));
  row.set("max_points", points_text(grades.max_points()));
  set_row_numbers(row, submission);
  for (std::size_t i = 0; i < grades.scenes.size(); ++i) {
    const GradedScene& scene = grades.scenes[i];
    const SceneGrade* grade = submission.scene(scene.name);
    cells.push_back(cell_data(scene, grade, folder, block_id(place, i)));
    if (grade == nullptr) continue;
    const PictureSource source = [&](const std::string& relative) { return pictures(scene, relative); };
    scenes.push_back(scene_block(scene, *grade, source, block_id(place, i), staff_title(scene)));
  }
  for (const GradeFlag& flag : submission.flags)
    flags.push_back(printable(flag_name(flag.kind) + ": " + flag.sentence));
  row.set("cells", cells);
  row.set("scenes", scenes);
  row.set("submission_flags", flags);
  row.set("has_speed", grades.speed_points > 0);
  row.set("speed", speed_block(grades, submission));
  set_build(row, submission);
  return row;
}

void set_likeness(data& page, const Grades& grades, const std::vector<const SubmissionGrade*>& order) {
  data groups(data::type::list), flags(data::type::list);
  bool has_groups = false, has_flags = false;
  for (const LikenessGroup& group : likeness_groups(grades)) {
    std::string names;
    for (const std::string& name : group.names) names += (names.empty() ? "" : ", ") + name;
    data item;
    item.set("names", printable(names));
    item.set("why", printable(group.why));
    groups.push_back(item);
    has_groups = true;
  }
  for (std::size_t place = 0; place < order.size(); ++place)
    for (const GradeFlag& flag : order[place]->flags) {
      data item;
      item.set("id", submission_id(place));
      item.set("name", printable(order[place]->name));
      item.set("kind", printable(flag_name(flag.kind)));
      item.set("meaning", printable(flag_meaning(flag.kind)));
      item.set("told", printable(flag.sentence));
      flags.push_back(item);
      has_flags = true;
    }
  page.set("has_groups", has_groups);
  page.set("groups", groups);
  page.set("has_flags", has_flags);
  page.set("flags", flags);
  page.set("has_likeness", has_groups || has_flags);
}

void set_head(data& page, const Grades& grades) {
  page.set("assignment", printable(grades.title.empty() ? grades.assignment : grades.title));
  page.set("created", printable(time_text(grades.created)));
  page.set("host", printable(host_text(grades.host)));
  page.set("versions", printable(versions_text(grades.versions)));
  page.set("containment", printable(grades.containment));
  page.set("seed", std::to_string(grades.seed));
  page.set("command", printable(grades.command));
  std::vector<std::string> caveats = grades.caveats;
  if (grades.interrupted) caveats.insert(caveats.begin(), "The run was interrupted: grades are not complete.");
  if (!grades.contained) caveats.insert(caveats.begin(), "Submissions ran without a sandbox.");
  page.set("caveats", text_list(caveats));
  data answers(data::type::list);
  for (const StaffAnswer& answer : staff_answers(grades)) {
    data item;
    item.set("question", answer.question);
    item.set("is_bad", answer.is_bad);
    item.set("parts", text_list(answer.parts));
    answers.push_back(item);
  }
  page.set("answers", answers);
  page.set("max_correctness", points_text(grades.correctness_points));
  page.set("max_speed", points_text(grades.speed_points));
  page.set("rule", text_or_false(grades.speed_rule));
}

/// Facts about the scenes, for the page's end.
data scene_facts(const Grades& grades) {
  data list(data::type::list);
  for (const GradedScene& scene : grades.scenes) {
    std::string text =
        fmt::format("{} × {} pixels, {} points", scene.width, scene.height, points_text(scene.max_points));
    if (scene.timed) text += ", timed";
    if (!scene.variant.empty()) text += fmt::format("; {} of scene {}", scene.variant, scene.of);
    if (!scene.says.empty()) text += ": " + scene.says;
    if (!scene.reference.empty()) text += "; reference: " + scene.reference;
    if (!scene.unused.empty()) text += "; does not count: " + scene.unused;
    data item;
    item.set("title", printable(staff_title(scene)));
    item.set("text", printable(text));
    list.push_back(item);
  }
  return list;
}

std::string staff_html(const Grades& grades, const fs::path& folder, const fs::path& out) {
  const std::vector<const SubmissionGrade*> order = leaderboard(grades);
  const LinkedPictures pictures(folder, out);
  data page, rows(data::type::list), columns(data::type::list);
  set_page_parts(page);
  set_head(page, grades);
  for (const GradedScene& scene : grades.scenes) columns.push_back(column_data(scene, folder));
  for (std::size_t place = 0; place < order.size(); ++place)
    rows.push_back(submission_row(grades, *order[place], place, folder, pictures));
  page.set("columns", columns);
  page.set("rows", rows);
  const std::string points = class_points_svg(grades), speeds = class_speeds_svg(grades);
  page.set("points_plot", points.empty() ? data(false) : data(points));
  page.set("speeds_plot", speeds.empty() ? data(false) : data(speeds));
  set_likeness(page, grades, order);
  page.set("scene_facts", scene_facts(grades));
  return rendered_page(grade_templates::grade_staff, page);
}

}  // namespace
}  // namespace photonproof::reports::inline reports_grades

namespace photonproof::inline reports_grades {

void write_staff_page(const Grades& grades, const std::filesystem::path& folder, const std::filesystem::path& out) {
  write_file_atomically(out, reports::staff_html(grades, folder, out));
}

}  // namespace photonproof::inline reports_grades
