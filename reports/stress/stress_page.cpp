#include <fmt/format.h>

#include <algorithm>
#include <kainjow/mustache.hpp>
#include <map>

#include "reports/page/page_parts.h"
#include "reports/page/picture.h"
#include "reports/page/templates.h"
#include "reports/stress/stress_templates.h"
#include "reports/stress/stress_view.h"
#include "reports/view/view.h"
#include "scenes/base/utf8.h"
#include "scenes/files/atomic_file.h"

namespace photonproof::reports::inline reports_stress {
namespace {

using kainjow::mustache::data;

const char* class_of(LevelOutcome outcome) {
  switch (outcome) {
    case LevelOutcome::right:
      return "right";
    case LevelOutcome::degraded:
      return "degraded";
    case LevelOutcome::refused:
      return "refused";
    case LevelOutcome::undecided:
      return "undecided";
    default:
      return "wrong";
  }
}

/// One mark per level, distinct in shape as well as in colour.
std::string level_mark(const StressLevel& level, double x) {
  switch (level.outcome) {
    case LevelOutcome::right:
      return fmt::format("<circle cx=\"{:g}\" cy=\"8\" r=\"3.5\"/>", x);
    case LevelOutcome::degraded:
      return fmt::format("<path d=\"M{:g} 3.5l4 8h-8z\"/>", x);
    case LevelOutcome::refused:
      return fmt::format("<path d=\"M{:g} 4v8\"/>", x);
    case LevelOutcome::undecided:
      return fmt::format("<circle cx=\"{:g}\" cy=\"8\" r=\"3\"/>", x);
    default:
      return fmt::format("<path d=\"M{:g} 4l7 8m0 -8l-7 8\"/>", x - 3.5);
  }
}

/// The sweep's levels from left to right, evenly spaced; levels that were not climbed are only a line.
std::string strip_svg(const StressSweep& sweep, const std::vector<double>& heights) {
  constexpr double step = 15, margin = 8;
  const double width = 2 * margin + step * static_cast<double>(std::max<std::size_t>(1, heights.size()) - 1);
  std::string svg = fmt::format(
      "<svg class=\"strip\" width=\"{0:g}\" height=\"16\" viewBox=\"0 0 {0:g} 16\" role=\"img\" "
      "aria-label=\"{1}\"><path "
      "class=\"rail\" d=\"M{2:g} 8H{3:g}\"/>",
      width, sweep_words(sweep), margin, width - margin);
  for (const StressLevel& level : sweep.levels) {
    const auto at = std::find(heights.begin(), heights.end(), level.height) - heights.begin();
    svg += fmt::format("<g class=\"{}\"><title>k = {:g}: {}</title>{}</g>", class_of(level.outcome), level.height,
                       to_string(level.outcome), level_mark(level, margin + step * static_cast<double>(at)));
  }
  return svg + "</svg>";
}

/// Sweeps of the same feature and climb form a row.
struct SweepRow {
  const StressSweep* first;
  std::map<std::string, const StressSweep*> by_engine;
  std::vector<double> heights;
};

std::vector<SweepRow> sweep_rows(const StressRecord& record) {
  std::vector<SweepRow> rows;
  for (const StressSweep& sweep : record.sweeps) {
    auto row = std::find_if(rows.begin(), rows.end(), [&](const SweepRow& r) {
      return r.first->feature == sweep.feature && r.first->sweep_run == sweep.sweep_run;
    });
    if (row == rows.end()) row = rows.insert(rows.end(), SweepRow{&sweep, {}, {}});
    row->by_engine[sweep.engine] = &sweep;
    for (const StressLevel& level : sweep.levels) row->heights.push_back(level.height);
  }
  for (SweepRow& row : rows) {
    std::sort(row.heights.begin(), row.heights.end());
    row.heights.erase(std::unique(row.heights.begin(), row.heights.end()), row.heights.end());
  }
  return rows;
}

data sweep_row_data(const SweepRow& row, const std::vector<std::string>& engines) {
  data out, cells(data::type::list);
  out.set("feature", printable(row.first->feature));
  out.set("climb", printable(row.first->sweep_run));
  out.set("measure", printable(row.first->measure));
  out.set("wanted", row.first->wanted < 0 ? "" : fmt::format("{:g}", row.first->wanted));
  for (const std::string& engine : engines) {
    data cell;
    const auto found = row.by_engine.find(engine);
    const bool is_swept = found != row.by_engine.end() && found->second->not_swept.empty();
    cell.set("strip", is_swept ? strip_svg(*found->second, row.heights) : "");
    cell.set("words", found == row.by_engine.end() ? "" : sweep_words(*found->second));
    cell.set("state", !is_swept ? "quiet" : found->second->breakdown() != nullptr ? "bad" : "good");
    cells.push_back(cell);
  }
  out.set("cells", cells);
  return out;
}

data picture_data(const std::filesystem::path& folder, const std::string& file, const char* caption) {
  data out;
  const EmbeddedPicture picture = file.empty() ? EmbeddedPicture{} : embed_thumbnail(folder, file, 64);
  out.set("uri", picture.uri);
  out.set("has_picture", !picture.uri.empty());
  out.set("caption", caption);
  return out;
}

/// The first level that fails, else the first declared to be wrong, with both pictures.
data finding_data(const StressSweep& sweep, const StressLevel& level, const std::filesystem::path& folder) {
  data out, pictures(data::type::list);
  out.set("feature", printable(sweep.feature));
  out.set("climb", printable(sweep.sweep_run));
  out.set("engine", printable(sweep.engine));
  out.set("measure", printable(sweep.measure));
  out.set("height", fmt::format("{:g}", level.height));
  out.set("outcome", to_string(level.outcome));
  out.set("class", class_of(level.outcome));
  out.set("chip", is_failure(level.outcome) ? "poor" : "open");
  out.set("sentence", printable(level.sentence));
  if (!level.expected.empty()) pictures.push_back(picture_data(folder, level.expected, "right"));
  if (!level.picture.empty()) pictures.push_back(picture_data(folder, level.picture, to_string(level.outcome).c_str()));
  out.set("pictures", pictures);
  return out;
}

data findings_data(const StressRecord& record, bool failures, const std::filesystem::path& folder) {
  data list(data::type::list);
  for (const StressSweep& sweep : record.sweeps)
    for (const StressLevel& level : sweep.levels) {
      const bool is_limit = level.outcome == LevelOutcome::degraded || level.outcome == LevelOutcome::undecided ||
                            (level.outcome == LevelOutcome::refused && level.height <= sweep.wanted);
      if (failures ? !is_failure(level.outcome) : !is_limit) continue;
      list.push_back(finding_data(sweep, level, folder));
      break;
    }
  return list;
}

data summary_data(const StressRecord& record, const std::vector<std::string>& engines) {
  const std::vector<SweepRunSummary> all = summaries(record);
  std::vector<std::string> sweep_runs;
  for (const SweepRunSummary& s : all)
    if (std::find(sweep_runs.begin(), sweep_runs.end(), s.sweep_run) == sweep_runs.end())
      sweep_runs.push_back(s.sweep_run);
  data rows(data::type::list);
  for (const std::string& sweep_run : sweep_runs) {
    if (sweep_run == "its own") continue;
    data row, cells(data::type::list);
    row.set("climb", printable(sweep_run));
    for (const std::string& engine : engines) {
      const auto found = std::find_if(all.begin(), all.end(), [&](const SweepRunSummary& s) {
        return s.sweep_run == sweep_run && s.engine == engine;
      });
      data cell;
      const bool is_there = found != all.end();
      cell.set("value", !is_there           ? ""
                        : found->to_the_top ? "all"
                        : found->lowest     ? fmt::format("{:g}", *found->lowest)
                                            : "–");
      cell.set("feature", is_there && !found->to_the_top ? printable(found->feature) : "");
      cell.set("state", is_there && found->wrong > 0 ? "bad" : "good");
      cells.push_back(cell);
    }
    row.set("cells", cells);
    rows.push_back(row);
  }
  return rows;
}

}  // namespace

void write_stress_page(const StressRecord& record, const std::vector<std::string>& worse,
                       const std::filesystem::path& folder, const std::filesystem::path& out) {
  const std::vector<std::string> engines = engines_of(record);
  data page, names(data::type::list), rows(data::type::list), steps(data::type::list);
  set_style_and_script(page, std::string(templates::style) + std::string(stress_templates::stress_style),
                       stress_templates::script, stress_templates::script_sha256);
  for (const std::string& engine : engines) names.push_back(printable(engine));
  for (const SweepRow& row : sweep_rows(record)) rows.push_back(sweep_row_data(row, engines));
  for (const std::string& sentence : worse) steps.push_back(printable(sentence));
  page.set("totals", stress_totals(record) + (record.interrupted ? "; interrupted" : ""));
  page.set("fails", record.fails());
  page.set("created", printable(time_text(record.created)));
  page.set("host", printable(record.host));
  page.set("program", printable(record.program));
  page.set("command", printable(record.command));
  page.set("seconds", fmt::format("{:.0f}", record.seconds));
  page.set("engines", names);
  page.set("rows", rows);
  page.set("summary", summary_data(record, engines));
  page.set("failures", findings_data(record, true, folder));
  page.set("limits", findings_data(record, false, folder));
  page.set("has_steps", !worse.empty());
  page.set("steps", steps);
  write_file_atomically(out, rendered_page(stress_templates::stress, page));
}

}  // namespace photonproof::reports::inline reports_stress
