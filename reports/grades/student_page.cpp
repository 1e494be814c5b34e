#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <utility>

#include "reports/grades/grade_data.h"
#include "reports/grades/grade_pages.h"
#include "reports/grades/grade_templates.h"
#include "reports/grades/grade_words.h"
#include "reports/grades/hidden_words.h"
#include "reports/page/html_data.h"
#include "reports/page/page_parts.h"
#include "reports/page/picture.h"
#include "reports/view/environment.h"
#include "reports/view/text.h"
#include "reports/view/view.h"
#include "scenes/files/atomic_file.h"

namespace photonproof::reports::inline reports_grades {
namespace {

using kainjow::mustache::data;

constexpr int longest_embedded_side = 640;

std::string student_id(std::size_t index) { return "scene-" + std::to_string(index + 1); }

bool is_timed(const SubmissionGrade& submission) { return !submission.speed.scenes.empty(); }

/// The reason why speed has no points yet, in words.
std::string untimed_words(const SpeedGrade& speed) {
  if (speed.state == SpeedGrade::State::changed) return "images changed while timed";
  constexpr std::string_view lead = "not timed: ";
  if (speed.sentence.starts_with(lead)) return speed.sentence.substr(lead.size());
  if (!speed.sentence.empty()) return speed.sentence;
  return speed.state == SpeedGrade::State::not_right ? "a scene that it needs is not right"
                                                     : "this grading has no times";
}

data score_card(const std::string& name, double got, double most, bool is_total) {
  data card;
  card.set("untimed", false);
  card.set("remark", data(false));
  card.set("score_name", name);
  card.set("got", points_text(got));
  card.set("most", points_text(most));
  card.set("percent", fmt::format("{:.1f}", most > 0 ? std::clamp(100 * got / most, 0.0, 100.0) : 0.0));
  card.set("is_total", is_total);
  return card;
}

data scores_data(const Grades& grades, const SubmissionGrade& submission) {
  data scores(data::type::list);
  scores.push_back(score_card("Points", submission.points(), grades.max_points(), true));
  scores.push_back(score_card("Correctness", submission.correctness_points, grades.correctness_points, false));
  if (grades.speed_points <= 0) return scores;
  data speed = score_card("Speed", submission.speed.points, grades.speed_points, false);
  speed.set("untimed", !is_timed(submission));
  speed.set("remark",
            printable(is_timed(submission) ? speed_words(submission.speed.speedup) : untimed_words(submission.speed)));
  scores.push_back(speed);
  return scores;
}

data causes_data(const std::vector<std::string>& causes) {
  data list(data::type::list);
  for (const std::string& cause : causes) list.push_back(printable(cause));
  return list;
}

bool is_bad(const SceneGrade& grade) {
  return grade.verdict == SceneVerdict::wrong || grade.verdict == SceneVerdict::failed;
}

/// A mistake, with its cause and the scenes that have it.
struct Problem {
  const SceneGrade* first = nullptr;
  std::string what, place;
  std::vector<std::string> causes;
  std::vector<std::pair<std::string, std::string>> scenes{};  ///< id, title
};

Problem problem_of(const Grades& grades, const SubmissionGrade& submission, const GradedScene& scene,
                   const SceneGrade& grade) {
  if (scene.hidden) {
    HiddenWords words = hidden_words(grades, submission, grade);
    return {&grade, std::move(words.sentence), {}, std::move(words.causes)};
  }
  if (grade.findings.empty()) return {&grade, grade.sentence, {}, {}};
  const GradedFinding& finding = grade.findings.front();
  Problem problem{&grade, finding.sentence, place_text(finding, scene), {}};
  if (!finding.cause.empty()) problem.causes.push_back(finding.cause);
  return problem;
}

void add_problem(std::vector<Problem>& problems, Problem problem, const std::string& id, const std::string& title) {
  const auto same = std::ranges::find_if(problems, [&](const Problem& other) {
    return other.what == problem.what && other.causes == problem.causes &&
           other.first->verdict == problem.first->verdict;
  });
  Problem& shown = same == problems.end() ? problems.emplace_back(std::move(problem)) : *same;
  shown.scenes.emplace_back(id, title);
}

data problems_data(const std::vector<Problem>& problems) {
  data list(data::type::list);
  for (const Problem& problem : problems) {
    data item, links(data::type::list);
    for (std::size_t i = 0; i < problem.scenes.size(); ++i) {
      data link;
      link.set("comma", i > 0);
      link.set("anchor", problem.scenes[i].first);
      link.set("title", printable(problem.scenes[i].second));
      links.push_back(link);
    }
    item.set("chip", chip_data(*problem.first));
    item.set("links", links);
    item.set("what", printable(problem.what));
    item.set("place", problem.place.empty()        ? data(false)
                      : problem.scenes.size() == 1 ? data(printable(problem.place))
                                                   : data(printable(problem.scenes[0].second + ": " + problem.place)));
    item.set("causes", causes_data(problem.causes));
    list.push_back(item);
  }
  return list;
}

/// The step that gains the most: build, mend the first mistake, or reach the next tier.
std::string next_words(const Grades& grades, const SubmissionGrade& submission, const std::vector<Problem>& problems) {
  if (!submission.built) return "Make it build: the build’s output is below.";
  if (!problems.empty()) {
    std::string text = "Mend " + problems.front().scenes.front().second + ", as told below.";
    if (grades.speed_points > 0 && submission.speed.state == SpeedGrade::State::not_right)
      text += " Speed is timed once the images are right.";
    return text;
  }
  const std::string tier = tier_words(grades, submission.speed);
  if (!tier.empty()) return tier;
  return submission.points() < grades.max_points() ? "The images are right; speed is not timed yet."
                                                   : "Nothing: all points are reached.";
}

/// The first mistake of a scene that may be shown, as pictures with the place marked. Empty if there is none.
data first_pictures(const Grades& grades, const std::vector<Problem>& problems, const PictureSource& picture) {
  for (const Problem& problem : problems)
    for (const GradedScene& scene : grades.scenes) {
      if (scene.name != problem.first->scene || scene.hidden) continue;
      if (picture_file(problem.first->pictures, "image").empty()) continue;
      return shots_data(scene, *problem.first, picture, student_title(grades, scene), 2);
    }
  return data(data::type::list);
}

data hidden_block(const Grades& grades, const SubmissionGrade& submission, const GradedScene& scene,
                  const SceneGrade& grade, const std::string& id) {
  const HiddenWords words = hidden_words(grades, submission, grade);
  data block;
  block.set("id", id);
  block.set("title", student_title(grades, scene));
  block.set("chip", chip_data(grade));
  block.set("points", points_text(grade.points));
  block.set("max_points", points_text(scene.max_points));
  block.set("what", text_or_false(words.sentence));
  block.set("causes", causes_data(words.causes));
  block.set("has_checks", !grade.checks.empty());
  block.set("checks", checks_data(grade.checks));
  return block;
}

data points_row(const std::string& title, double points, double most) {
  data row;
  row.set("title", printable(title));
  row.set("anchor", data(false));
  row.set("chip", data(false));
  row.set("state", data(false));
  row.set("pending", false);
  row.set("points", points_text(points));
  row.set("max_points", points_text(most));
  return row;
}

void set_scenes(data& page, const Grades& grades, const SubmissionGrade& submission,
                const std::filesystem::path& folder) {
  const PictureSource picture = [&](const std::string& relative) {
    const EmbeddedPicture found = embed_thumbnail(folder, relative, longest_embedded_side);
    return PagePicture{found.uri, found.problem, found.width, found.height, {}};
  };
  data scenes(data::type::list), hidden(data::type::list), rows(data::type::list);
  std::vector<Problem> problems;
  bool has_hidden = false;
  for (std::size_t i = 0; i < grades.scenes.size(); ++i) {
    const GradedScene& scene = grades.scenes[i];
    const SceneGrade* grade = submission.scene(scene.name);
    if (grade == nullptr) continue;
    const std::string id = student_id(i), title = student_title(grades, scene);
    data row = points_row(title, grade->points, scene.max_points);
    row.set("anchor", id);
    row.set("chip", chip_data(*grade));
    rows.push_back(row);
    if (is_bad(*grade)) add_problem(problems, problem_of(grades, submission, scene, *grade), id, title);
    has_hidden = has_hidden || scene.hidden;
    if (scene.hidden)
      hidden.push_back(hidden_block(grades, submission, scene, *grade, id));
    else
      scenes.push_back(scene_block(scene, *grade, picture, id, title));
  }
  data speed = points_row("Speed", submission.speed.points, grades.speed_points);
  speed.set("anchor", "speed");
  speed.set("state", is_timed(submission) ? to_string(submission.speed.state) : "not timed");
  speed.set("pending", !is_timed(submission));
  if (grades.speed_points > 0) rows.push_back(speed);
  page.set("scenes", scenes);
  page.set("has_hidden", has_hidden);
  page.set("hidden_scenes", hidden);
  page.set("rows", rows);
  page.set("has_problems", !problems.empty());
  page.set("problems", problems_data(problems));
  page.set("next", printable(next_words(grades, submission, problems)));
  page.set("first_shots", first_pictures(grades, problems, picture));
}

std::string student_summary(const Grades& grades, const SubmissionGrade& submission) {
  if (!submission.built) return "Does not build: " + printable(submission.build_sentence);
  std::string text = correctness_words(grades, submission);
  text.front() = static_cast<char>(std::toupper(text.front()));
  if (!submission.speed.scenes.empty()) text += "; " + speed_words(submission.speed.speedup);
  return text + ".";
}

std::string student_html(const Grades& grades, const SubmissionGrade& submission, const std::filesystem::path& folder) {
  data page;
  set_page_parts(page);
  page.set("name", printable(submission.name));
  page.set("assignment", printable(grades.title.empty() ? grades.assignment : grades.title));
  page.set("summary", student_summary(grades, submission));
  page.set("scores", scores_data(grades, submission));
  page.set("total", points_text(submission.points()));
  page.set("max_total", points_text(grades.max_points()));
  set_scenes(page, grades, submission, folder);
  page.set("speed", speed_block(grades, submission));
  set_build(page, submission);
  page.set("created", printable(time_text(grades.created)));
  page.set("host", printable(host_text(grades.host)));
  page.set("containment", printable(grades.containment));
  return rendered_page(grade_templates::grade_student, page);
}

}  // namespace
}  // namespace photonproof::reports::inline reports_grades

namespace photonproof::inline reports_grades {

void write_student_page(const Grades& grades, const SubmissionGrade& submission, const std::filesystem::path& folder,
                        const std::filesystem::path& out) {
  write_file_atomically(out, reports::student_html(grades, reports::as_students_read(grades, submission), folder));
}

}  // namespace photonproof::inline reports_grades
