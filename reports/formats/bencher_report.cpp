// A benchmark is an engine on a scene at a budget. Its measures are the harness's conclusions over seeds, with their
// intervals. Without conclusions each cell is its own benchmark, seed included. Gates are benchmarks too.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "reports/formats/exchange_reports.h"
#include "reports/view/text.h"
#include "scenes/files/atomic_file.h"

namespace photonproof::inline reports_formats {
namespace {

using nlohmann::json;

json measure(const Estimate& estimate) {
  json j = {{"value", estimate.value}};
  if (estimate.interval) {
    j["lower_value"] = estimate.interval->low;
    j["upper_value"] = estimate.interval->high;
  }
  return j;
}

template <class T>
void set(json& benchmark, const std::string& name, const std::optional<T>& value) {
  if (value) benchmark[name] = {{"value", *value}};
}

void set(json& benchmark, const std::string& name, const std::optional<Estimate>& estimate) {
  if (estimate) benchmark[name] = measure(*estimate);
}

/// Bencher limits a benchmark's name to 1024 bytes.
std::string name_of(const std::string& text) { return reports::shortened(reports::printable(text), 1024); }

bool has_curve(const Results& results, const Cell& cell) {
  for (const Convergence& curve : results.convergence) {
    if (curve.scene == cell.scene && curve.engine == cell.engine) {
      for (const ConvergencePoint& point : curve.points) {
        if (point.budget == cell.budget) return true;
      }
    }
  }
  return false;
}

json cell_measures(const Result& result) {
  json benchmark = json::object();
  set(benchmark, "seconds", result.wall_seconds);
  set(benchmark, "cpu-seconds", result.cpu_seconds);
  set(benchmark, "peak-bytes", result.peak_bytes);
  set(benchmark, "instructions", result.instructions);
  for (const MetricValue& metric : result.metrics)
    benchmark[name_of(metric.name).substr(0, 64)] = {{"value", metric.value}};
  return benchmark;
}

void add_curve(json& all, const Convergence& curve) {
  const std::string prefix = curve.scene + "/" + curve.engine;
  for (const ConvergencePoint& point : curve.points) {
    json& benchmark = all[name_of(prefix + "/" + point.budget.label())];
    benchmark["seconds"] = measure(point.seconds);
    set(benchmark, "relmse", point.relmse);
    set(benchmark, "bias2", point.bias2);
    set(benchmark, "variance", point.variance);
  }
  json summary = json::object();
  set(summary, "slope", curve.slope);
  set(summary, "efficiency", curve.efficiency);
  for (const TargetTime& target : curve.targets)
    set(summary, fmt::format("seconds-to-relmse-{}", target.relmse), target.seconds);
  if (!summary.empty()) all[name_of(prefix)] = summary;
}

}  // namespace

void write_bencher_report(const Results& results, const std::filesystem::path&, const std::filesystem::path& out) {
  json all = json::object();
  for (const Result& result : results.results) {
    if (result.status != Status::ok || has_curve(results, result.cell)) continue;
    const json measures = cell_measures(result);
    if (!measures.empty()) all[name_of(result.cell.label())] = measures;
  }
  for (const Convergence& curve : results.convergence) add_curve(all, curve);
  for (const GateRecord& gate : results.gates) {
    json& benchmark = all[name_of("gate/" + gate.name)];
    benchmark["seconds"] = {{"value", gate.seconds}};
    set(benchmark, name_of(gate.metric).substr(0, 64), gate.observed);
  }
  write_file_atomically(out, all.dump(2, ' ', false, json::error_handler_t::replace) + "\n");
}

}  // namespace photonproof::inline reports_formats
