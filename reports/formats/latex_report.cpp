// Tables for a paper, included by \input: each engine's result at its largest budget, errors against time, and gates,
// as far as the record has them.
#include <fmt/format.h>

#include "reports/formats/exchange_reports.h"
#include "reports/view/conclusions.h"
#include "reports/view/metric_columns.h"
#include "reports/view/numbers.h"
#include "reports/view/text.h"
#include "reports/view/verdicts.h"
#include "reports/view/view.h"
#include "scenes/files/atomic_file.h"

namespace photonproof::inline reports_formats {
using namespace reports;

namespace {

/// A label of letters, digits and dashes, as \ref wants it.
std::string label_text(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-';
    out += plain ? c : '-';
  }
  return out;
}

/// The command that ends the row above would read a leading bracket or star of the first cell as its argument.
std::string line(const std::vector<std::string>& cells) {
  std::string text;
  for (const std::string& cell : cells) text += (text.empty() ? "  " : " & ") + latex_text(cell);
  if (const char first = text[2]; first == '[' || first == '*') text.replace(2, 1, std::string("{") + first + "}");
  return text + " \\\\\n";
}

/// The first `left` columns are text, the others numbers. A change in the first column is set apart.
std::string float_of(const PlainTable& table, std::size_t left, const std::string& caption, const std::string& label) {
  std::string columns(left, 'l');
  columns.append(table.header.size() - left, 'r');
  std::string text = "\n\\begin{table}\n  \\centering\n  \\caption{" + latex_text(caption) +
                     "}\n  \\label{tab:" + label_text(label) + "}\n  \\begin{tabular}{" + columns + "}\n  \\toprule\n" +
                     line(table.header) + "  \\midrule\n";
  std::string last;
  for (const std::vector<std::string>& row : table.rows) {
    const bool again = row.front() == last;
    if (!again && !last.empty()) text += "  \\addlinespace\n";
    last = row.front();
    std::vector<std::string> cells = row;
    if (again) cells.front().clear();
    text += line(cells);
  }
  return text + "  \\bottomrule\n  \\end{tabular}\n\\end{table}\n";
}

PlainTable errors_table(const View& view) {
  PlainTable table{{"Scene", "Engine", "Budget"}, {}};
  for (const MetricColumn& column : metric_columns()) table.header.push_back(column.title);
  table.header.push_back("wall s");
  for (const SceneView& scene : view.scenes) {
    for (const EngineOutcome& outcome : scene.engines) {
      if (!outcome.shown) continue;
      const Result& shown = *outcome.shown;
      auto& row =
          table.rows.emplace_back(std::vector{scene.record.name, shown.cell.engine, budget_text(shown.cell.budget)});
      for (const MetricColumn& column : metric_columns()) {
        row.push_back(or_dash(metric(shown, column.metric), column.format) + doubt_mark(scene));
      }
      row.push_back(or_dash(shown.wall_seconds, [](double v) { return significant(v); }));
    }
  }
  return table;
}

/// One table over all scenes, with the scene in the first column.
template <class MakeTable, class Members>
PlainTable by_scene(const View& view, MakeTable make, Members members) {
  PlainTable all;
  for (const SceneView& scene : view.scenes) {
    // The header names the table's clock, which only a scene with entries has.
    if (all.header.empty() || !(scene.*members).empty()) all.header = make(scene.*members).header;
    for (std::vector<std::string>& row : make(scene.*members).rows) {
      row.insert(row.begin(), scene.record.name);
      all.rows.push_back(row);
    }
  }
  all.header.insert(all.header.begin(), "Scene");
  return all;
}

}  // namespace

void write_latex_report(const Results& results, const std::filesystem::path&, const std::filesystem::path& out) {
  const View view = arrange(results);
  const std::string& suite = results.suite;
  std::string text = "% Made by photonproof from results.json of the suite " + ascii_text(suite) + ", " +
                     ascii_text(time_text(results.created)) + ".\n% Repeat with: " + ascii_text(results.command) +
                     "\n% Needs \\usepackage{booktabs}.\n";
  const auto add = [&](const PlainTable& table, std::size_t left, const std::string& caption, const char* label) {
    if (!table.rows.empty()) text += float_of(table, left, heading(results) + ": " + caption, suite + "-" + label);
  };
  add(errors_table(view), 3, "errors against each scene's reference, at the largest budget an engine finished.",
      "errors");
  add(by_scene(
          view, [](const std::vector<const Convergence*>& curves) { return points_table(curves); }, &SceneView::curves),
      3, "error against time over seeds, with 95 % intervals.", "points");
  add(by_scene(view, slopes_table, &SceneView::curves), 2, "slope of log relMSE on log seconds, and efficiency.",
      "slopes");
  add(by_scene(view, gates_table, &SceneView::gates), 5, "gates and their verdicts.", "gates");
  write_file_atomically(out, text);
}

}  // namespace photonproof::inline reports_formats
