// Lists only cells that finished and were timed, since compare.py takes the geometric mean of all times. Metrics,
// memory and counts are user counters. Seeds are repetitions of one name, as compare.py's U test needs.
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "reports/formats/exchange_reports.h"
#include "reports/view/text.h"
#include "reports/view/view.h"
#include "scenes/files/atomic_file.h"

namespace photonproof::inline reports_formats {
using namespace reports;

namespace {

using nlohmann::ordered_json;

bool is_timed(const Result& result) {
  return result.status == Status::ok && result.wall_seconds && result.cpu_seconds && *result.wall_seconds > 0 &&
         *result.cpu_seconds > 0;
}

std::string run_name(const Cell& cell) { return printable(cell.scene + "/" + cell.engine + "/" + cell.budget.label()); }

/// The names with a meaning in this format: a counter of that name would replace a time.
const std::set<std::string>& own_names() {
  static const std::set<std::string> names{"name",
                                           "run_name",
                                           "run_type",
                                           "repetitions",
                                           "repetition_index",
                                           "family_index",
                                           "per_family_instance_index",
                                           "threads",
                                           "iterations",
                                           "real_time",
                                           "cpu_time",
                                           "time_unit",
                                           "label",
                                           "aggregate_name",
                                           "aggregate_unit",
                                           "error_occurred",
                                           "error_message"};
  return names;
}

void set_counter(ordered_json& run, const std::string& name, double value) {
  const std::string safe = printable(name);
  run[own_names().contains(safe) ? "counter_" + safe : safe] = value;
}

ordered_json run_of(const Result& result, int repetitions, int index) {
  ordered_json run = {{"name", run_name(result.cell)},
                      {"run_name", run_name(result.cell)},
                      {"run_type", "iteration"},
                      {"repetitions", repetitions},
                      {"repetition_index", index},
                      {"threads", 1},
                      {"iterations", 1},
                      {"real_time", *result.wall_seconds * 1e3},
                      {"cpu_time", *result.cpu_seconds * 1e3},
                      {"time_unit", "ms"},
                      {"label", "seed " + std::to_string(result.cell.seed)}};
  for (const MetricValue& metric : result.metrics) set_counter(run, metric.name, metric.value);
  if (result.peak_bytes) set_counter(run, "peak_bytes", static_cast<double>(*result.peak_bytes));
  if (result.instructions) set_counter(run, "instructions", static_cast<double>(*result.instructions));
  for (const auto& [name, count] : result.counts) set_counter(run, name, count);
  return run;
}

}  // namespace

void write_gbench_report(const Results& results, const std::filesystem::path&, const std::filesystem::path& out) {
  std::map<std::string, int> repetitions, seen;
  for (const Result& result : results.results) {
    if (is_timed(result)) ++repetitions[run_name(result.cell)];
  }
  ordered_json runs = ordered_json::array();
  for (const Result& result : results.results) {
    if (!is_timed(result)) continue;
    const std::string name = run_name(result.cell);
    runs.push_back(run_of(result, repetitions[name], seen[name]++));
  }
  const ordered_json all = {{"context",
                             {{"date", printable(results.created)},
                              {"host_name", printable(results.host.cpu)},
                              {"executable", printable(results.command)},
                              {"num_cpus", results.host.cores},
                              {"caches", ordered_json::array()},
                              {"library_build_type", "release"},
                              {"json_schema_version", 1}}},
                            {"benchmarks", runs}};
  write_file_atomically(out, all.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n");
}

}  // namespace photonproof::inline reports_formats
