// A row for each scene, engine and budget that finished, with a column for each number. Spreadsheets and data frames
// plot it without a pivot.
//
// `seeds` counts the finished cells. `clock` is that of `seconds`, wall or processor.
// `seconds` and `relmse` are those of the curve: median and mean over seeds, with the ends of their 95 % intervals.
// Without a curve they are means of the cells.
// `bias2` and `variance` are as in the tidy form. `verdict` is right, noisy, biased or unknown, and empty without one.
// Each further column is a metric of the record, its mean over the finished cells.
#include <fmt/format.h>

#include <algorithm>

#include "reports/formats/exchange_reports.h"
#include "reports/view/text.h"
#include "reports/view/view.h"
#include "scenes/files/atomic_file.h"

namespace photonproof::inline reports_formats {
using namespace reports;

namespace {

std::string number(double value) { return fmt::format("{}", value); }

std::string number(const std::optional<Estimate>& estimate) { return estimate ? number(estimate->value) : ""; }

std::string ends(const std::optional<Estimate>& estimate) {
  if (!estimate || !estimate->interval) return ",";
  return number(estimate->interval->low) + "," + number(estimate->interval->high);
}

/// The cells of a budget.
using Cells = std::vector<const Result*>;

template <class Value>
std::optional<double> mean_of(const Cells& cells, Value value) {
  double sum = 0;
  int count = 0;
  for (const Result* cell : cells)
    if (const std::optional<double> v = value(*cell)) {
      sum += *v;
      ++count;
    }
  return count == 0 ? std::nullopt : std::optional(sum / count);
}

std::vector<std::string> metric_names(const Results& results) {
  std::vector<std::string> names;
  for (const Result& result : results.results)
    for (const MetricValue& value : result.metrics)
      if (std::ranges::find(names, value.name) == names.end()) names.push_back(value.name);
  return names;
}

const ConvergencePoint* point_of(const SceneView& scene, const Cell& cell, Clock& clock) {
  for (const Convergence* curve : scene.curves) {
    if (curve->engine != cell.engine) continue;
    const auto point = std::ranges::find(curve->points, cell.budget, &ConvergencePoint::budget);
    if (point == curve->points.end()) continue;
    clock = curve->clock;
    return &*point;
  }
  return nullptr;
}

std::string row_of(const SceneView& scene, const Cells& cells, const std::vector<std::string>& metrics) {
  const Cell& cell = cells.front()->cell;
  Clock clock = Clock::wall;
  const ConvergencePoint* point = point_of(scene, cell, clock);
  const auto mean = [&](const std::string& name) {
    return mean_of(cells, [&](const Result& result) { return metric(result, name); });
  };
  std::optional<Estimate> seconds, relmse;
  if (point) {
    seconds = point->seconds;
    relmse = point->relmse;
  } else {
    if (const auto value = mean_of(cells, [](const Result& r) { return r.wall_seconds; }))
      seconds = Estimate{*value, {}};
    if (const auto value = mean("relmse")) relmse = Estimate{*value, {}};
  }
  std::string row = csv_cell(cell.scene) + "," + csv_cell(cell.engine) + "," + csv_cell(cell.budget.kind) + "," +
                    cell.budget.amount_text() + "," + std::to_string(cells.size()) + "," + to_string(clock) + "," +
                    number(seconds) + "," + ends(seconds) + "," + number(relmse) + "," + ends(relmse) + "," +
                    (point ? number(point->bias2) : "") + "," + (point ? number(point->variance) : "") + "," +
                    (point && point->correctness ? to_string(point->correctness->verdict) : "");
  for (const std::string& name : metrics) {
    if (name == "relmse") continue;
    const auto value = mean(name);
    row += "," + (value ? number(*value) : "");
  }
  return row + "\r\n";
}

}  // namespace

void write_wide_csv_report(const Results& results, const std::filesystem::path&, const std::filesystem::path& out) {
  const View view = arrange(results);
  const std::vector<std::string> metrics = metric_names(results);
  std::string text =
      "scene,engine,budget_kind,budget,seeds,clock,seconds,seconds_low,seconds_high,relmse,relmse_low,relmse_high,"
      "bias2,variance,verdict";
  for (const std::string& name : metrics)
    if (name != "relmse") text += "," + csv_cell(name);
  text += "\r\n";
  for (const SceneView& scene : view.scenes) {
    for (const EngineOutcome& outcome : scene.engines) {
      Cells cells;
      for (const Result* cell : outcome.cells) {
        if (cell->status != Status::ok) continue;
        if (!cells.empty() && !(cells.front()->cell.budget == cell->cell.budget)) {
          text += row_of(scene, cells, metrics);
          cells.clear();
        }
        cells.push_back(cell);
      }
      if (!cells.empty()) text += row_of(scene, cells, metrics);
    }
  }
  write_file_atomically(out, text);
}

}  // namespace photonproof::inline reports_formats
