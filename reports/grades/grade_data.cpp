#include "reports/grades/grade_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "reports/grades/grade_plots.h"
#include "reports/grades/grade_templates.h"
#include "reports/grades/grade_words.h"
#include "reports/page/html_data.h"
#include "reports/page/page_parts.h"
#include "reports/page/templates.h"
#include "reports/view/numbers.h"
#include "reports/view/text.h"
#include "reports/view/view.h"

namespace photonproof::reports::inline reports_grades {
namespace {

using kainjow::mustache::data;

struct Shot {
  const char* role;
  const char* title;
  std::string file;
};

/// A box over the picture, in percent of its sides.
data mark_data(const GradedFinding& finding, const GradedScene& scene, std::size_t number) {
  const auto percent = [](double part, int whole) {
    return fmt::format("{:.3f}", std::clamp(100 * part / whole, 0.0, 100.0));
  };
  const double right = std::min(finding.x + finding.width, scene.width),
               bottom = std::min(finding.y + finding.height, scene.height);
  data mark;
  mark.set("number", std::to_string(number));
  mark.set("left", percent(finding.x, scene.width));
  mark.set("top", percent(finding.y, scene.height));
  mark.set("across", percent(right - std::max(finding.x, 0), scene.width));
  mark.set("down", percent(bottom - std::max(finding.y, 0), scene.height));
  return mark;
}

bool has_place(const GradedFinding& finding, const GradedScene& scene) {
  return scene.width > 0 && scene.height > 0 && finding.width > 0 && finding.height > 0 && finding.x < scene.width &&
         finding.y < scene.height && finding.x + finding.width > 0 && finding.y + finding.height > 0 &&
         !is_whole_image(finding, scene);
}

data marks_data(const GradedScene& scene, const SceneGrade& grade) {
  data marks(data::type::list);
  for (std::size_t i = 0; i < grade.findings.size(); ++i)
    if (has_place(grade.findings[i], scene)) marks.push_back(mark_data(grade.findings[i], scene, i + 1));
  return marks;
}

}  // namespace

data shots_data(const GradedScene& scene, const SceneGrade& grade, const PictureSource& picture,
                const std::string& title, std::size_t most) {
  const Shot shots[] = {{"submitted", "submitted", picture_file(grade.pictures, "image")},
                        {"reference", "reference", scene.reference_picture},
                        {"flip", "FLIP: where they differ", picture_file(grade.pictures, "flip")}};
  data list(data::type::list);
  for (const Shot& shot : std::span(shots).first(std::min(most, std::size(shots)))) {
    if (shot.file.empty() && std::string_view(shot.role) == "flip") continue;
    const PagePicture found = picture(shot.file);
    data item;
    item.set("role", shot.role);
    item.set("title", shot.title);
    item.set("has_picture", found.problem.empty());
    item.set("address", found.address);
    item.set("link", found.link.empty() ? data(false) : data(found.link));
    item.set("width", std::to_string(found.width));
    item.set("height", std::to_string(found.height));
    item.set("problem", printable(found.problem));
    item.set("alt", printable(std::string(shot.title) + ", " + title));
    item.set("marks", found.problem.empty() ? marks_data(scene, grade) : data(data::type::list));
    list.push_back(item);
  }
  return list;
}

namespace {

data findings_data(const GradedScene& scene, const SceneGrade& grade) {
  data list(data::type::list);
  for (const GradedFinding& finding : grade.findings) {
    data item;
    item.set("found", printable(finding.sentence));
    item.set("cause", text_or_false(finding.cause));
    item.set("place", text_or_false(place_text(finding, scene)));
    item.set("share",
             finding.explained > 0 ? data(fmt::format("{:.0f} % of the error", 100 * finding.explained)) : data(false));
    list.push_back(item);
  }
  return list;
}

data runs_data(const std::vector<GradedRun>& runs) {
  data list(data::type::list);
  for (const GradedRun& run : runs) {
    data item;
    item.set("seed", std::to_string(run.seed));
    item.set("end", printable(run.end));
    item.set("why", text_or_false(run.sentence));
    item.set("wall", significant(run.wall_seconds));
    item.set("cpu", significant(run.cpu_seconds));
    item.set("peak", megabytes(run.peak_bytes));
    item.set("log", run.log_tail.empty() ? data(false) : data(log_text(run.log_tail)));
    list.push_back(item);
  }
  return list;
}

data swatch_data(PlotRole role) {
  const RoleStyle style = role_style(role);
  data swatch;
  swatch.set("color", style.color);
  swatch.set("shape", style.shape);
  return swatch;
}

/// The scene's sentence, unless the first finding has the same one.
data sentence_data(const SceneGrade& grade) {
  if (!grade.findings.empty() && grade.findings.front().sentence == grade.sentence) return data(false);
  return text_or_false(grade.sentence);
}

}  // namespace

data chip_data(const SceneGrade& grade) {
  data chip;
  chip.set("class", verdict_class(grade.verdict));
  chip.set("symbol", verdict_symbol(grade.verdict));
  chip.set("verdict", printable(verdict_words(grade)));
  return chip;
}

data checks_data(const std::vector<GradedCheck>& checks) {
  data list(data::type::list);
  for (const GradedCheck& check : checks) {
    data item;
    item.set("metric", printable(check.metric));
    item.set("value", significant(check.value.value));
    item.set("bound", significant(check.bound));
    item.set("side", to_string(check.side));
    item.set("is_outside", check.side == GradedCheck::Side::outside);
    list.push_back(item);
  }
  return list;
}

data scene_block(const GradedScene& scene, const SceneGrade& grade, const PictureSource& picture, const std::string& id,
                 const std::string& title) {
  data block;
  block.set("id", id);
  block.set("title", printable(title));
  block.set("hidden", scene.hidden);
  block.set("chip", chip_data(grade));
  block.set("points", points_text(grade.points));
  block.set("max_points", points_text(scene.max_points));
  block.set("says", text_or_false(scene.says));
  block.set("unused", text_or_false(scene.unused));
  block.set("reference_says", text_or_false(scene.reference));
  block.set("sentence", sentence_data(grade));
  block.set("has_findings", !grade.findings.empty());
  block.set("findings", findings_data(scene, grade));
  const bool has_shots = !picture_file(grade.pictures, "image").empty();
  block.set("has_shots", has_shots);
  block.set("shots", has_shots ? shots_data(scene, grade, picture, title, 3) : data(data::type::list));
  block.set("has_checks", !grade.checks.empty());
  block.set("checks", checks_data(grade.checks));
  data sentences(data::type::list);
  for (const GradedCheck& check : grade.checks)
    if (!check.sentence.empty() && check.sentence != grade.sentence) sentences.push_back(printable(check.sentence));
  block.set("check_sentences", sentences);
  block.set("has_runs", !grade.runs.empty());
  block.set("runs", runs_data(grade.runs));
  block.set("has_more", !grade.checks.empty() || !grade.runs.empty());
  return block;
}

data speed_block(const Grades& grades, const SubmissionGrade& submission) {
  const SpeedGrade& speed = submission.speed;
  data block;
  block.set("state", to_string(speed.state));
  block.set("speed_sentence", text_or_false(speed.sentence));
  block.set("tier", text_or_false(tier_words(grades, speed)));
  block.set("rule", text_or_false(grades.speed_rule));
  const std::string tiers =
      speed.scenes.empty() ? "" : tiers_plot_svg(grades, speed.speedup, "Speed-up of " + submission.name);
  block.set("tiers_plot", tiers.empty() ? data(false) : data(tiers));
  data scenes(data::type::list);
  for (const SceneSpeed& scene : speed.scenes) {
    const std::string plot = rounds_plot_svg(scene, "Seconds a round, scene " + scene.scene);
    if (plot.empty()) continue;
    data item;
    item.set("scene", printable(scene.scene));
    item.set("ratio", speed_text(scene.ratio));
    item.set("plot", plot);
    scenes.push_back(item);
  }
  block.set("timed", scenes);
  block.set("baseline", swatch_data(PlotRole::baseline));
  block.set("own", swatch_data(PlotRole::own));
  block.set("noise", swatch_data(PlotRole::noise));
  return block;
}

void set_build(data& object, const SubmissionGrade& submission) {
  object.set("built", submission.built);
  object.set("build_sentence", text_or_false(submission.build_sentence));
  object.set("build_seconds", significant(submission.build_seconds));
  object.set("build_log", submission.build_log.empty() ? data(false) : data(log_text(submission.build_log)));
}

void set_page_parts(data& page) {
  set_style_and_script(page, std::string(templates::style) + std::string(grade_templates::grade_style),
                       grade_templates::script, grade_templates::script_sha256);
  set_partial(page, "swatch_svg", templates::swatch_svg);
  set_partial(page, "verdict_chip", templates::verdict_chip);
  set_partial(page, "grade_scene", grade_templates::grade_scene);
  set_partial(page, "grade_speed", grade_templates::grade_speed);
  set_partial(page, "grade_build", grade_templates::grade_build);
}

}  // namespace photonproof::reports::inline reports_grades
