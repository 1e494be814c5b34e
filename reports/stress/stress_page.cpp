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

const char* class_of(RungOutcome outcome) {
  switch (outcome) {
    case RungOutcome::right:
      return "right";
    case RungOutcome::degraded:
      return "degraded";
    case RungOutcome::refused:
      return "refused";
    case RungOutcome::undecided:
      return "undecided";
    default:
      return "wrong";
  }
}

/// A mark a rung, told apart by shape as well as by colour.
std::string rung_mark(const StressRung& rung, double x) {
  switch (rung.outcome) {
    case RungOutcome::right:
      return fmt::format("<circle cx=\"{:g}\" cy=\"8\" r=\"3.5\"/>", x);
    case RungOutcome::degraded:
      return fmt::format("<path d=\"M{:g} 3.5l4 8h-8z\"/>", x);
    case RungOutcome::refused:
      return fmt::format("<path d=\"M{:g} 4v8\"/>", x);
    case RungOutcome::undecided:
      return fmt::format("<circle cx=\"{:g}\" cy=\"8\" r=\"3\"/>", x);
    default:
      return fmt::format("<path d=\"M{:g} 4l7 8m0 -8l-7 8\"/>", x - 3.5);
  }
}

/// The ladder's rungs from left to right, evenly spaced, those that were not climbed as a line alone.
std::string strip_svg(const StressLadder& ladder, const std::vector<double>& heights) {
  constexpr double step = 15, margin = 8;
  const double width = 2 * margin + step * static_cast<double>(std::max<std::size_t>(1, heights.size()) - 1);
  std::string svg = fmt::format(
      "<svg class=\"strip\" width=\"{0:g}\" height=\"16\" viewBox=\"0 0 {0:g} 16\" role=\"img\" "
      "aria-label=\"{1}\"><path "
      "class=\"rail\" d=\"M{2:g} 8H{3:g}\"/>",
      width, ladder_words(ladder), margin, width - margin);
  for (const StressRung& rung : ladder.rungs) {
    const auto at = std::find(heights.begin(), heights.end(), rung.height) - heights.begin();
    svg += fmt::format("<g class=\"{}\"><title>k = {:g}: {}</title>{}</g>", class_of(rung.outcome), rung.height,
                       to_string(rung.outcome), rung_mark(rung, margin + step * static_cast<double>(at)));
  }
  return svg + "</svg>";
}

/// Ladders of the same feature and climb are a row.
struct LadderRow {
  const StressLadder* first;
  std::map<std::string, const StressLadder*> by_engine;
  std::vector<double> heights;
};

std::vector<LadderRow> ladder_rows(const StressRecord& record) {
  std::vector<LadderRow> rows;
  for (const StressLadder& ladder : record.ladders) {
    auto row = std::find_if(rows.begin(), rows.end(), [&](const LadderRow& r) {
      return r.first->feature == ladder.feature && r.first->climb == ladder.climb;
    });
    if (row == rows.end()) row = rows.insert(rows.end(), LadderRow{&ladder, {}, {}});
    row->by_engine[ladder.engine] = &ladder;
    for (const StressRung& rung : ladder.rungs) row->heights.push_back(rung.height);
  }
  for (LadderRow& row : rows) {
    std::sort(row.heights.begin(), row.heights.end());
    row.heights.erase(std::unique(row.heights.begin(), row.heights.end()), row.heights.end());
  }
  return rows;
}

data ladder_row_data(const LadderRow& row, const std::vector<std::string>& engines) {
  data out, cells(data::type::list);
  out.set("feature", printable(row.first->feature));
  out.set("climb", printable(row.first->climb));
  out.set("measure", printable(row.first->measure));
  out.set("wanted", row.first->wanted < 0 ? "" : fmt::format("{:g}", row.first->wanted));
  for (const std::string& engine : engines) {
    data cell;
    const auto found = row.by_engine.find(engine);
    const bool is_climbed = found != row.by_engine.end() && found->second->not_climbed.empty();
    cell.set("strip", is_climbed ? strip_svg(*found->second, row.heights) : "");
    cell.set("words", found == row.by_engine.end() ? "" : ladder_words(*found->second));
    cell.set("state", !is_climbed ? "quiet" : found->second->breakdown() != nullptr ? "bad" : "good");
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

/// The first rung that fails, or else the first that is only said to be wrong, with both pictures.
data finding_data(const StressLadder& ladder, const StressRung& rung, const std::filesystem::path& folder) {
  data out, pictures(data::type::list);
  out.set("feature", printable(ladder.feature));
  out.set("climb", printable(ladder.climb));
  out.set("engine", printable(ladder.engine));
  out.set("measure", printable(ladder.measure));
  out.set("height", fmt::format("{:g}", rung.height));
  out.set("outcome", to_string(rung.outcome));
  out.set("class", class_of(rung.outcome));
  out.set("chip", is_failure(rung.outcome) ? "poor" : "open");
  out.set("sentence", printable(rung.sentence));
  if (!rung.expected.empty()) pictures.push_back(picture_data(folder, rung.expected, "right"));
  if (!rung.picture.empty()) pictures.push_back(picture_data(folder, rung.picture, to_string(rung.outcome).c_str()));
  out.set("pictures", pictures);
  return out;
}

data findings_data(const StressRecord& record, bool failures, const std::filesystem::path& folder) {
  data list(data::type::list);
  for (const StressLadder& ladder : record.ladders)
    for (const StressRung& rung : ladder.rungs) {
      const bool is_limit = rung.outcome == RungOutcome::degraded || rung.outcome == RungOutcome::undecided ||
                            (rung.outcome == RungOutcome::refused && rung.height <= ladder.wanted);
      if (failures ? !is_failure(rung.outcome) : !is_limit) continue;
      list.push_back(finding_data(ladder, rung, folder));
      break;
    }
  return list;
}

data summary_data(const StressRecord& record, const std::vector<std::string>& engines) {
  const std::vector<ClimbSummary> all = summaries(record);
  std::vector<std::string> climbs;
  for (const ClimbSummary& s : all)
    if (std::find(climbs.begin(), climbs.end(), s.climb) == climbs.end()) climbs.push_back(s.climb);
  data rows(data::type::list);
  for (const std::string& climb : climbs) {
    if (climb == "its own") continue;
    data row, cells(data::type::list);
    row.set("climb", printable(climb));
    for (const std::string& engine : engines) {
      const auto found = std::find_if(all.begin(), all.end(),
                                      [&](const ClimbSummary& s) { return s.climb == climb && s.engine == engine; });
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
  for (const LadderRow& row : ladder_rows(record)) rows.push_back(ladder_row_data(row, engines));
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
