#include "reports/view/console_conclusions.h"

#include <string_view>
#include <vector>

#include "reports/view/console_table.h"
#include "reports/view/numbers.h"
#include "reports/view/races.h"
#include "reports/view/verdicts.h"

namespace photonproof::reports::inline reports_view {
namespace {

using Row = std::vector<ConsoleCell>;

Emphasis emphasis_of(const CorrectnessRecord& record) {
  const std::string_view look = verdict_class(record);
  return look == "good" ? Emphasis::good : look == "poor" ? Emphasis::poor : Emphasis::none;
}

/// Engines at their largest budgets; numbers have the mark of a doubtful reference.
std::string verdict_table(const View& view, bool colours) {
  const auto number = [](double value) { return significant(value); };
  std::vector<Row> rows;
  for (const SceneView& scene : view.scenes) {
    bool again = false;
    for (const EngineOutcome& outcome : scene.engines) {
      if (outcome.shown == nullptr) continue;
      const Result& shown = *outcome.shown;
      const CorrectnessRecord* record = correctness_of(scene, shown.cell);
      if (record == nullptr) continue;
      rows.push_back({{scene.record.name, again ? Emphasis::quiet : Emphasis::none},
                      {shown.cell.engine},
                      {budget_text(shown.cell.budget)},
                      {verdict_text(*record), emphasis_of(*record)},
                      {or_dash(metric(shown, "relmse"), number) + doubt_mark(scene)},
                      {or_dash(shown.wall_seconds, number)}});
      again = true;
    }
  }
  if (rows.empty()) return {};
  return console_table({"scene", "engine", "budget", "verdict", "relMSE", "seconds"}, rows, 4, colours) + "\n";
}

/// Rows without a judgement follow as sentences.
std::string races_table(const RaceTable& races, const std::string& head, const std::string& at, bool colours) {
  std::vector<std::string> header{head, at};
  header.insert(header.end(), races.engines.begin(), races.engines.end());
  std::vector<Row> rows;
  std::string undecided;
  for (const RaceTable::Row& race : races.rows) {
    if (!race.undecided.empty()) {
      undecided += race.scene + ": not judged, " + race.undecided + "\n";
      continue;
    }
    Row& row = rows.emplace_back(Row{{race.scene}, {race.at}});
    for (const RaceTable::Cell& cell : race.cells)
      row.push_back({cell.ratio.empty() ? cell.value : cell.value + ", " + cell.ratio,
                     cell.best ? Emphasis::bold : Emphasis::none});
  }
  std::string text = undecided;
  if (!rows.empty()) text = console_table(header, rows, header.size(), colours) + text;
  return text.empty() ? text : text + "\n";
}

}  // namespace

std::string console_conclusions(const View& view, bool colours) {
  std::string text = verdict_table(view, colours) + races_table(race_table(view), "time to", "relMSE", colours) +
                     races_table(error_table(view), "relMSE in", "time", colours);
  for (const std::string& note : verdict_notes(view)) text += note + "\n";
  return text.empty() ? text : "\n" + text;
}

}  // namespace photonproof::reports::inline reports_view
