#include "reports/history/history_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <utility>

#include "reports/record/gate_metrics.h"
#include "reports/view/numbers.h"

namespace photonproof::reports::inline reports_history {
namespace {

constexpr std::array measure_names{"processor seconds", "wall seconds", "instructions", "relMSE", "gate"};

/// "12", "0.4", "130": a percentage without sign.
std::string percent(double fraction) { return significant(std::abs(100 * fraction), 2); }

/// The first word of a gate's budget is its metric.
std::string gate_metric(const SeriesKey& key) {
  return key.measure == Measure::gate ? key.budget.substr(0, key.budget.find(',')) : "";
}

/// A gate that observes a relative error, and one whose values are better if they are larger.
bool is_relative_gate(const SeriesKey& key) { return weighs_noise(gate_metric(key)); }
bool is_likeness(const SeriesKey& key) {
  const std::string metric = gate_metric(key);
  return metric == "ssim" || metric == "ms_ssim" || metric == "psnr";
}

/// "+0.040 %", "−3.1 %"; "0 %" where it rounds to 0.000.
std::string signed_percentage(double fraction) {
  constexpr double least = 5e-6;
  if (std::abs(fraction) < least) return "0 %";
  return (fraction > 0 ? "+" : "") + significant(100 * fraction, 2) + " %";
}

/// Ends of a change, in its direction: of a fall by 12 % they are 9 and 15.
std::string interval_text(const HistoryStep& step, bool falls) {
  if (!step.interval) return "";
  double low = 100 * step.interval->low, high = 100 * step.interval->high;
  if (falls) {
    std::swap(low, high);
    low = -low;
    high = -high;
  }
  return fmt::format(" [{}, {}]", significant(low, 2), significant(high, 2));
}

std::size_t commit_of(const NamedStep& named) { return named.series->points[named.step->point].commit; }

}  // namespace

const char* to_string(Measure measure) { return measure_names.at(static_cast<std::size_t>(measure)); }

std::optional<Measure> measure_named(const std::string& name) {
  const auto found = std::ranges::find(measure_names, name);
  if (found == measure_names.end()) return std::nullopt;
  return static_cast<Measure>(found - measure_names.begin());
}

std::string commit_text(const std::string& name) {
  const bool is_hash = name.size() > 10 && name.find_first_not_of("0123456789abcdefABCDEF") == std::string::npos;
  return is_hash ? name.substr(0, 10) : name;
}

std::string date_text(std::int64_t seconds) {
  using namespace std::chrono;
  const sys_seconds time{std::chrono::seconds(seconds)};
  const auto day = floor<days>(time);
  const year_month_day date{day};
  const auto minutes_of_day = floor<minutes>(time - day).count();
  return fmt::format("{:04}-{:02}-{:02} {:02}:{:02} UTC", int(date.year()), unsigned(date.month()),
                     unsigned(date.day()), minutes_of_day / 60, minutes_of_day % 60);
}

std::string value_text(const SeriesKey& key, double value) {
  switch (key.measure) {
    case Measure::processor_seconds:
    case Measure::wall_seconds:
      return significant(value) + " s";
    case Measure::instructions:
      return value >= 1e9   ? significant(value / 1e9) + " G"
             : value >= 1e6 ? significant(value / 1e6) + " M"
                            : significant(value);
    case Measure::gate:
      if (is_relative_gate(key)) return signed_percentage(value);
      break;
    case Measure::relmse:
      break;
  }
  return significant(value);
}

std::string change_text(const SeriesKey& key, const HistoryStep& step) {
  if (!step.relative)
    return fmt::format("moved from {} to {}", value_text(key, step.before), value_text(key, step.after));
  const bool falls = step.change < 0;
  const std::string by = step.change > 9 ? fmt::format("to {} times", significant(1 + step.change, 2))
                                         : percent(step.change) + " %" + interval_text(step, falls);
  return (falls ? "fell " : "rose ") + by;
}

double size_of(const HistoryStep& step) { return std::abs(step.relative ? std::log1p(step.change) : step.change); }

bool is_worse(const SeriesKey& key, const HistoryStep& step) {
  const bool is_signed = is_relative_gate(key);
  const bool grows = is_signed ? std::abs(step.after) > std::abs(step.before) : step.after > step.before;
  return grows != is_likeness(key);
}

std::string measure_text(const SeriesKey& key) {
  switch (key.measure) {
    case Measure::processor_seconds:
      return "processor time";
    case Measure::wall_seconds:
      return "wall time";
    case Measure::gate:
      return "gate " + key.budget;
    default:
      return to_string(key.measure);
  }
}

std::string subject_text(const SeriesKey& key) {
  return fmt::format("{} of {} on {}", measure_text(key), key.engine, key.scene);
}

std::vector<NamedStep> steps_of(const History& history) {
  std::vector<NamedStep> steps;
  for (const HistorySeries& series : history.series)
    for (const HistoryStep& step : series.steps) steps.push_back({&series, &step});
  std::ranges::stable_sort(steps, [&](const NamedStep& a, const NamedStep& b) {
    return commit_of(a) != commit_of(b) ? commit_of(a) > commit_of(b) : size_of(*a.step) > size_of(*b.step);
  });
  return steps;
}

std::string last_step_sentence(const History& history) {
  const std::vector<NamedStep> steps = steps_of(history);
  if (steps.empty()) {
    const auto judged =
        std::ranges::count_if(history.series, [](const HistorySeries& series) { return series.is_judged; });
    return fmt::format("No step in {} series of {} commit{}", judged, history.commits.size(),
                       history.commits.size() == 1 ? "" : "s");
  }
  const NamedStep& last = steps.front();
  const std::size_t commit = commit_of(last);
  const auto others = std::ranges::count_if(steps, [&](const NamedStep& n) { return commit_of(n) == commit; }) - 1;
  return fmt::format("{} {} at {}{}", subject_text(last.series->key), change_text(last.series->key, *last.step),
                     commit_text(history.commits[commit].name),
                     others == 0 ? "" : fmt::format(", and {} more at this commit", others));
}

}  // namespace photonproof::reports::inline reports_history
