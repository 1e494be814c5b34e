// Tables for a paper, included by \input. Races to equal error, errors at equal time and at the largest budgets, errors
// against time, slopes and gates, as far as the record has them.
#include <fmt/format.h>

#include <algorithm>

#include "reports/paper/latex_table.h"
#include "reports/paper/paper_formats.h"
#include "reports/paper/paper_words.h"
#include "reports/view/conclusions.h"
#include "reports/view/metric_columns.h"
#include "reports/view/numbers.h"
#include "reports/view/races.h"
#include "reports/view/text.h"
#include "reports/view/verdicts.h"
#include "reports/view/view.h"
#include "scenes/base/input_error.h"
#include "scenes/files/atomic_file.h"

namespace photonproof::inline reports_paper {
using namespace reports;

namespace {

/// The numbers of one method on one scene.
struct Entry {
  std::string scene;   ///< with the condition that the numbers hold under: "Cornell, relMSE 0.005"
  std::string method;  ///< its title
  std::vector<LatexCell> cells;
};

/// Numbers that a table shows with methods as rows or as columns.
struct Quantities {
  std::string name;     ///< of the table, in its label
  std::string caption;  ///< what the numbers are, without a full stop
  std::string note;     ///< more sentences of the caption, from the space on
  std::vector<LatexColumn> columns;
  std::vector<Entry> entries;
  bool pivots = true;  ///< whether methods may be columns
  std::string stub = "Method";
};

LatexTable methods_as_rows(const Quantities& all, const Results& results) {
  LatexTable table{
      heading(results) + ": " + all.caption, all.note, results.suite + "-" + all.name, all.stub, all.columns, {}};
  for (const Entry& entry : all.entries) table.rows.push_back({entry.scene, entry.method, entry.cells});
  return table;
}

/// One table of scenes against methods for a quantity.
LatexTable methods_as_columns(const Quantities& all, std::size_t quantity, const Results& results) {
  const std::string& title = all.columns[quantity].title;
  LatexTable table{heading(results) + ": " + title + "; " + all.caption,
                   all.note,
                   results.suite + "-" + all.name + "-" + title,
                   "Scene",
                   {},
                   {}};
  std::vector<std::string> methods;
  for (const Entry& entry : all.entries)
    if (std::ranges::find(methods, entry.method) == methods.end()) methods.push_back(entry.method);
  for (const std::string& method : methods) table.columns.push_back({method, all.columns[quantity].is_text});
  for (const Entry& entry : all.entries) {
    auto row = std::ranges::find(table.rows, entry.scene, &LatexRow::stub);
    if (row == table.rows.end())
      row = table.rows.insert(row,
                              {"", entry.scene, std::vector<LatexCell>(methods.size(), LatexCell{undefined_number})});
    row->cells[static_cast<std::size_t>(std::ranges::find(methods, entry.method) - methods.begin())] =
        entry.cells[quantity];
  }
  return table;
}

/// The condition of a race after its scene.
std::string at_error(const View& view, const RaceRecord& race) {
  return scene_title(view, race.scene) + ", relMSE " + significant(race.relmse, 2);
}

Quantities race_quantities(const View& view) {
  Quantities all{"races",
                 "time to equal error, and how many times the fastest method's it is",
                 " Times are " + clock_text(clock_of(view)) +
                     ". Ratios are 95 % intervals. Bold: sooner than all others beyond noise.",
                 {{"Time"}, {"Ratio"}},
                 {}};
  const RaceTable table = race_table(view);
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const RaceRecord& race = *view.races[r];
    if (race.times.empty()) {
      all.entries.push_back(
          {scene_title(view, race.scene), "not judged", {{undefined_number, false, race.undecided}, {""}}});
      continue;
    }
    for (const RaceRecord::Time& time : race.times) {
      const auto engine = std::ranges::find(table.engines, time.engine);
      if (engine == table.engines.end()) continue;
      const RaceTable::Cell& cell = table.rows[r].cells[static_cast<std::size_t>(engine - table.engines.begin())];
      const std::string open = time.unranked ? "a bound that leaves the order open" : "";
      all.entries.push_back(
          {at_error(view, race), method_title(view, time.engine), {{cell.value, cell.best, open}, {cell.ratio}}});
    }
  }
  return all;
}

Quantities equal_time_quantities(const View& view) {
  Quantities all{"equal-time",
                 "relMSE at equal time, and how many times the least it is",
                 " Times are " + clock_text(clock_of(view)) + ". Ratios are 95 % intervals. Bold: least beyond noise.",
                 {{"relMSE"}, {"Ratio"}},
                 {}};
  for (const RaceRecord* race : view.races) {
    const auto& errors = race->errors;
    const bool won = errors.size() > 1 && std::all_of(errors.begin() + 1, errors.end(), [](const auto& error) {
                       return error.ratio && error.ratio->interval && error.ratio->interval->low > 1;
                     });
    for (const RaceRecord::Error& error : errors)
      all.entries.push_back({scene_title(view, race->scene) + ", " + significant(race->seconds, 2) + " s",
                             method_title(view, error.engine),
                             {{significant(error.relmse.value, 2), won && &error == &errors.front()},
                              {error.ratio ? times_text(*error.ratio) : ""}}});
  }
  return all;
}

Quantities error_quantities(const View& view) {
  Quantities all{"errors",
                 "errors against each scene's reference, at the largest budget a method finished",
                 " Times are wall-clock seconds.",
                 {{"Budget", true}},
                 {}};
  for (const MetricColumn& column : metric_columns())  // a column's title beside "relMSE" need not repeat it
    all.columns.push_back({std::string(column.metric) == "relmse_trimmed" ? "trimmed" : column.title});
  all.columns.push_back({"wall s"});
  for (const SceneView& scene : view.scenes) {
    for (const EngineOutcome& outcome : scene.engines) {
      if (!outcome.shown) continue;
      const Result& shown = *outcome.shown;
      std::vector<LatexCell> cells{{budget_text(shown.cell.budget)}};
      for (const MetricColumn& column : metric_columns())
        cells.push_back({or_dash(metric(shown, column.metric), column.format) + doubt_mark(scene)});
      cells.push_back({or_dash(shown.wall_seconds, [](double v) { return significant(v); })});
      all.entries.push_back({scene_title(scene.record), method_title(view, shown.cell.engine), std::move(cells)});
    }
  }
  return all;
}

std::vector<LatexCell> cells_of(const std::vector<std::string>& row, std::size_t begin) {
  std::vector<LatexCell> cells;
  for (std::size_t i = begin; i < row.size(); ++i) cells.push_back(cell_with_note(row[i]));
  return cells;
}

std::vector<LatexColumn> columns_of(const PlainTable& table, std::size_t begin, std::size_t numbers) {
  std::vector<LatexColumn> columns;
  for (std::size_t i = begin; i < table.header.size(); ++i) columns.push_back({table.header[i], i < numbers});
  return columns;
}

Quantities point_quantities(const View& view) {
  Quantities all{"points",
                 "error against time over seeds, with 95 % intervals",
                 " Times are " + clock_text(clock_of(view)) + ".",
                 {},
                 {},
                 false,
                 "Budget"};
  for (const SceneView& scene : view.scenes) {
    if (scene.curves.empty()) continue;
    const PlainTable table = points_table(scene.curves, doubt_mark(scene));
    all.columns = columns_of(table, 2, 4);
    for (const auto& row : table.rows)
      all.entries.push_back({scene_title(scene.record) + ", " + method_title(view, row[0]), row[1], cells_of(row, 2)});
  }
  return all;
}

Quantities slope_quantities(const View& view) {
  Quantities all{"slopes",
                 "slope of log relMSE on log seconds, efficiency, and time to a target",
                 " Times are " + clock_text(clock_of(view)) + ".",
                 {},
                 {}};
  for (const SceneView& scene : view.scenes) {
    if (scene.curves.empty()) continue;
    const PlainTable table = slopes_table(scene.curves);
    all.columns = columns_of(table, 1, 0);
    all.columns.erase(all.columns.begin() + 2);  // the target, which is in the group's heading
    for (const auto& row : table.rows) {
      std::vector<LatexCell> cells = cells_of(row, 1);
      cells.erase(cells.begin() + 2);
      const std::string target = row[3] == undefined_number ? "" : ", relMSE " + row[3];
      all.entries.push_back({scene_title(scene.record) + target, method_title(view, row[0]), std::move(cells)});
    }
  }
  // Methods beside each other under one target.
  std::vector<std::string> order;
  for (const Entry& entry : all.entries) order.push_back(entry.scene);
  std::ranges::stable_sort(all.entries, {},
                           [&](const Entry& entry) { return std::ranges::find(order, entry.scene) - order.begin(); });
  return all;
}

Quantities gate_quantities(const View& view) {
  Quantities all{"gates", "gates and their verdicts", "", {}, {}, false, "Gate"};
  for (const SceneView& scene : view.scenes) {
    if (scene.gates.empty()) continue;
    const PlainTable table = gates_table(scene.gates);
    all.columns = columns_of(table, 1, 4);
    all.columns[0] = {"Verdict", true};
    for (const auto& row : table.rows) {
      std::vector<LatexCell> cells = cells_of(row, 1);
      cells[0] = {row[0]};  // the gate's name is in the stub
      all.entries.push_back({scene_title(scene.record), row[1], std::move(cells)});
    }
  }
  return all;
}

struct NamedTable {
  const char* name;
  Quantities (*make)(const View& view);
};
constexpr NamedTable named_tables[] = {
    {"races", race_quantities},   {"equal-time", equal_time_quantities}, {"errors", error_quantities},
    {"points", point_quantities}, {"slopes", slope_quantities},          {"gates", gate_quantities},
};

void check_tables(const PaperOptions& options) {
  std::string known;
  for (const NamedTable& table : named_tables) known += (known.empty() ? "" : ", ") + std::string(table.name);
  for (const std::string& name : options.tables)
    if (std::ranges::find(named_tables, name, [](const NamedTable& t) { return std::string(t.name); }) ==
        std::end(named_tables))
      throw InputError("--table", "no such table: " + name + "; there are " + known);
}

}  // namespace

void write_latex_report(const Results& results, const std::filesystem::path&, const std::filesystem::path& out,
                        const PaperOptions& options) {
  check_tables(options);
  const View view = arrange(results);
  std::string text = "% Made by photonproof from results.json of the suite " + ascii_text(results.suite) + ", " +
                     ascii_text(time_text(results.created)) + ".\n% Repeat with: " + ascii_text(results.command) +
                     "\n% Needs \\usepackage{booktabs}.\n";
  for (const NamedTable& table : named_tables) {
    if (!options.tables.empty() && std::ranges::find(options.tables, table.name) == options.tables.end()) continue;
    const Quantities all = table.make(view);
    if (all.pivots && options.methods == MethodsSide::columns)
      for (std::size_t q = 0; q < all.columns.size(); ++q) text += latex_table(methods_as_columns(all, q, results));
    else
      text += latex_table(methods_as_rows(all, results));
  }
  write_file_atomically(out, text);
}

}  // namespace photonproof::inline reports_paper
