#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "reports/stress/stress_view.h"

namespace photonproof::reports::inline reports_stress {

namespace {

/// Name of the common summary of climbs that few features have.
constexpr const char* own_sweep_run = "its own";

/// Where pictures stop being right; lower is worse.
double end_of(const StressSweep& sweep) {
  const std::optional<double> right = sweep.right_up_to();
  if (right && sweep.levels.back().outcome == LevelOutcome::right) return 1e9;
  return right ? *right : -1e9;
}

std::string height_words(const SweepRunSummary& summary) {
  if (summary.to_the_top) return "all";
  return summary.lowest ? fmt::format("{:g}", *summary.lowest) : "–";
}

}  // namespace

std::string sweep_words(const StressSweep& sweep) {
  if (!sweep.not_swept.empty()) return "–";
  const std::optional<double> right = sweep.right_up_to();
  const std::string start = right ? fmt::format("{:g}", *right) : "";
  const auto next = std::find_if(sweep.levels.begin(), sweep.levels.end(),
                                 [](const StressLevel& level) { return level.outcome != LevelOutcome::right; });
  if (next == sweep.levels.end()) return "all (" + start + ")";
  const StressLevel* broken = sweep.breakdown();
  std::string text = start;
  if (broken == nullptr || next->height < broken->height)
    text += fmt::format("{}{} from {:g}", text.empty() ? "" : ", ", to_string(next->outcome), next->height);
  if (broken != nullptr)
    text += fmt::format("{}{} at {:g}", text.empty() ? "" : ", ", to_string(broken->outcome), broken->height);
  return text;
}

bool ends_lower(const StressSweep& a, const StressSweep& b) {
  return std::pair(end_of(a), a.right_up_to()) < std::pair(end_of(b), b.right_up_to());
}

std::vector<std::string> engines_of(const StressRecord& record) {
  std::vector<std::string> engines;
  for (const StressSweep& sweep : record.sweeps)
    if (std::find(engines.begin(), engines.end(), sweep.engine) == engines.end()) engines.push_back(sweep.engine);
  return engines;
}

std::vector<SweepRunSummary> summaries(const StressRecord& record) {
  std::map<std::string, std::set<std::string>> features;
  for (const StressSweep& sweep : record.sweeps) features[sweep.sweep_run].insert(sweep.feature);
  std::vector<SweepRunSummary> all;
  for (const StressSweep& sweep : record.sweeps) {
    if (!sweep.not_swept.empty() || sweep.levels.empty() || sweep.wanted < 0) continue;
    const std::string sweep_run = features[sweep.sweep_run].size() > 3 ? sweep.sweep_run : own_sweep_run;
    auto found = std::find_if(all.begin(), all.end(), [&](const SweepRunSummary& s) {
      return s.sweep_run == sweep_run && s.engine == sweep.engine;
    });
    const bool is_first = found == all.end();
    if (is_first) {
      all.push_back({sweep_run, sweep.engine, 0, {}, true, "", 0});
      found = all.end() - 1;
    }
    ++found->features;
    if (sweep.breakdown() != nullptr) ++found->wrong;
    const double end = end_of(sweep);
    if (end >= 1e9) continue;
    const double lowest = found->to_the_top ? 1e9 : found->lowest.value_or(-1e9);
    if (found->to_the_top || end < lowest) {
      found->lowest = sweep.right_up_to();
      found->feature = sweep.feature;
    }
    found->to_the_top = false;
  }
  return all;
}

std::string stress_totals(const StressRecord& record) {
  std::string text;
  for (const LevelOutcome outcome : {LevelOutcome::right, LevelOutcome::degraded, LevelOutcome::refused,
                                     LevelOutcome::undecided, LevelOutcome::silently_wrong, LevelOutcome::crashed}) {
    const std::size_t n = record.count(outcome);
    const bool always = outcome == LevelOutcome::right || outcome == LevelOutcome::silently_wrong;
    if (n > 0 || always) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", n, to_string(outcome));
  }
  const auto left_out = std::count_if(record.sweeps.begin(), record.sweeps.end(),
                                      [](const StressSweep& sweep) { return !sweep.not_swept.empty(); });
  if (left_out > 0) text += fmt::format("; {} of {} sweeps left out", left_out, record.sweeps.size());
  return text;
}

std::string stress_table(const StressRecord& record) {
  const std::vector<std::string> engines = engines_of(record);
  const std::string title = "right up to k of";
  std::size_t widest = title.size();
  std::vector<std::string> sweep_runs;
  const std::vector<SweepRunSummary> all = summaries(record);
  for (const SweepRunSummary& s : all)
    if (s.sweep_run != own_sweep_run &&
        std::find(sweep_runs.begin(), sweep_runs.end(), s.sweep_run) == sweep_runs.end()) {
      sweep_runs.push_back(s.sweep_run);
      widest = std::max(widest, s.sweep_run.size());
    }
  std::string text = fmt::format("{:{}}", title, widest);
  for (const std::string& engine : engines) text += fmt::format(" {:>14}", engine);
  for (const std::string& sweep_run : sweep_runs) {
    text += fmt::format("\n{:{}}", sweep_run, widest);
    for (const std::string& engine : engines) {
      const auto found = std::find_if(all.begin(), all.end(), [&](const SweepRunSummary& s) {
        return s.sweep_run == sweep_run && s.engine == engine;
      });
      text += fmt::format(" {:>14}", found == all.end() ? "" : height_words(*found));
    }
  }
  text += "\n";
  for (const StressSweep& sweep : record.sweeps)
    if (sweep.not_swept.empty() && (sweep.breakdown() != nullptr || !sweep.reaches_wanted()))
      text += fmt::format("{}, {}, {}: {} (wanted {:g}; {})\n", sweep.feature, sweep.sweep_run, sweep.engine,
                          sweep_words(sweep), sweep.wanted, sweep.levels.back().sentence);
  return text + stress_totals(record) + "\n";
}

}  // namespace photonproof::reports::inline reports_stress
