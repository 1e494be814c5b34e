#include "harness/history/history_values.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <tuple>

#include "harness/statistics/statistics.h"
#include "reports/view/view.h"
#include "scenes/base/size_text.h"

namespace photonproof::inline harness_history {
namespace {

using reports::Measure;
using reports::SeriesKey;
using Cells = std::vector<const Result*>;

std::string machine_of(const Results& results) {
  return results.host.cpu + ", " + std::to_string(results.host.cores) + (results.host.cores == 1 ? " core" : " cores");
}

std::map<std::string, std::string> sizes_of(const Results& results) {
  std::map<std::string, std::string> sizes;
  for (const SceneRecord& scene : results.scenes) sizes[scene.name] = size_text(scene.width, scene.height);
  return sizes;
}

/// The finite numbers that `read` finds in the cells; none unless every cell has one, since a median of fewer seeds is
/// another quantity.
std::vector<double> numbers_of(const Cells& cells, const std::function<std::optional<double>(const Result&)>& read) {
  std::vector<double> numbers;
  for (const Result* cell : cells) {
    const std::optional<double> number = read(*cell);
    if (!number) return {};
    numbers.push_back(*number);
  }
  return numbers;
}

/// The mean relmse that the record concluded, with its interval; else that of the cells.
std::optional<Estimate> relmse_over(const Results& results, const Cells& cells) {
  const Cell& cell = cells.front()->cell;
  for (const Convergence& curve : results.convergence) {
    if (curve.scene != cell.scene || curve.engine != cell.engine) continue;
    for (const ConvergencePoint& point : curve.points) {
      if (!(point.budget == cell.budget) || !point.relmse) continue;
      Estimate found = *point.relmse;
      if (!found.interval) found.interval = point.spread_of_seeds;
      return found;
    }
  }
  const std::vector<double> errors =
      numbers_of(cells, [](const Result& result) { return reports::metric(result, "relmse"); });
  if (errors.empty()) return std::nullopt;
  return Estimate{mean_of(errors), {}};
}

class ValueList {
 public:
  void add(const SeriesKey& key, const Estimate& estimate, int seeds, std::optional<double> calibration = {},
           const std::string& verdict = {}) {
    if (!std::isfinite(estimate.value)) return;
    HistoryValue value{key, estimate.value, estimate.interval, calibration, seeds, verdict};
    if (value.interval && !(std::isfinite(value.interval->low) && std::isfinite(value.interval->high)))
      value.interval.reset();
    values_.push_back(value);
  }
  const std::vector<HistoryValue>& values() const { return values_; }

 private:
  std::vector<HistoryValue> values_;
};

Estimate median_estimate(const std::vector<double>& numbers) {
  const bool positive = *std::ranges::min_element(numbers) > 0;
  return positive ? estimated_time(numbers) : Estimate{median_of(numbers), {}};
}

void add_cells(const Results& results, const Cells& cells, SeriesKey key, ValueList& list) {
  const auto seeds = static_cast<int>(cells.size());
  if (const std::optional<Estimate> relmse = relmse_over(results, cells)) {
    key.measure = Measure::relmse;
    list.add(key, *relmse, seeds);
  }
  const auto add_median = [&](Measure measure, const std::vector<double>& numbers, const std::string& machine,
                              std::optional<double> calibration) {
    if (numbers.empty()) return;
    key.measure = measure;
    key.machine = machine;
    list.add(key, median_estimate(numbers), seeds, calibration);
  };
  std::set<std::string> workloads;
  const std::vector<double> calibrations = numbers_of(cells, [&](const Result& result) -> std::optional<double> {
    if (!result.calibration) return std::nullopt;
    workloads.insert(result.calibration->workload + ", " + std::to_string(result.calibration->threads));
    return result.calibration->seconds;
  });
  // Readings of two workloads are not comparable, so another workload is another series.
  const bool is_calibrated = !calibrations.empty() && workloads.size() == 1;
  const std::string machine = machine_of(results);
  add_median(Measure::processor_seconds, numbers_of(cells, [](const Result& result) { return result.cpu_seconds; }),
             machine + (is_calibrated ? ", calibration " + *workloads.begin() : ""),
             is_calibrated ? std::optional(median_of(calibrations)) : std::nullopt);
  add_median(Measure::wall_seconds, numbers_of(cells, [](const Result& result) { return result.wall_seconds; }),
             machine, {});
  add_median(Measure::instructions,
             numbers_of(cells,
                        [](const Result& result) -> std::optional<double> {
                          if (!result.instructions) return std::nullopt;
                          return static_cast<double>(*result.instructions);
                        }),
             machine, {});
}

}  // namespace

std::vector<const Result*> measured_cells(const Results& results) {
  std::set<std::string> references;
  for (const SceneRecord& scene : results.scenes) references.insert(scene.reference_label);
  Cells cells;
  for (const Result& result : results.results)
    if (result.status == Status::ok && !references.contains(result.cell.label())) cells.push_back(&result);
  return cells;
}

std::vector<HistoryValue> values_of(const Results& results) {
  std::map<std::string, std::string> sizes = sizes_of(results);
  std::map<std::tuple<std::string, std::string, std::string>, Cells> groups;
  for (const Result* result : measured_cells(results))
    groups[{result->cell.scene, result->cell.engine, result->cell.budget.label()}].push_back(result);
  ValueList list;
  for (const auto& [names, cells] : groups) {
    const Cell& cell = cells.front()->cell;
    add_cells(results, cells,
              {results.suite, cell.scene, sizes[cell.scene], cell.engine, reports::budget_text(cell.budget)}, list);
  }
  for (const GateRecord& gate : results.gates) {
    if (!gate.observed) continue;
    const std::string usual = gate.scene + "/" + gate.engine + "/" + gate.metric;
    list.add({results.suite, gate.scene, sizes[gate.scene], gate.engine,
              gate.metric + (gate.name == usual ? "" : ", " + gate.name), Measure::gate},
             *gate.observed, 0, {}, to_string(gate.verdict));
  }
  return list.values();
}

}  // namespace photonproof::inline harness_history
