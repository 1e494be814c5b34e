#include "harness/history/history_changes.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "harness/history/change_points.h"
#include "harness/history/history_steps.h"
#include "harness/statistics/statistics.h"
#include "harness/statistics/student.h"
#include "reports/history/history_words.h"
#include "scenes/base/input_error.h"

namespace photonproof::inline harness_history {
namespace {

using reports::HistoryChange;
using reports::HistoryComparison;
using reports::HistorySeries;

/// A series' points at both commits, by index, and the first point of the base's level.
struct Place {
  std::size_t base = 0, head = 0, level = 0;
};

std::optional<std::size_t> point_at(const HistorySeries& series, std::size_t commit) {
  const auto found = std::ranges::lower_bound(series.points, commit, {}, &reports::HistoryPoint::commit);
  if (found == series.points.end() || found->commit != commit) return std::nullopt;
  return static_cast<std::size_t>(found - series.points.begin());
}

/// The commits of the base's level: those since the last step up to it, without the head.
std::size_t level_start(const HistorySeries& series, std::size_t base, std::size_t head) {
  std::size_t start = 0;
  for (const reports::HistoryStep& step : series.steps)
    if (step.point <= base && step.point != head) start = step.point;
  return head < base ? std::max(start, head + 1) : start;
}

/// A difference with its noise.
struct Judgement {
  double before = 0, after = 0;  ///< on the compared scale
  bool relative = true;
  double standard_error = 0, quantile = 1.96;
  bool exceeds = true;  ///< every noise that is known
  bool is_known = false;
};

void judge_by(Judgement& judged, double standard_error, double freedom, double tail) {
  judged.is_known = true;
  if (standard_error > judged.standard_error) {
    judged.standard_error = standard_error;
    judged.quantile = student_975(freedom);
  }
  if (!(std::abs(judged.after - judged.before) > t_quantile(tail, freedom) * standard_error)) judged.exceeds = false;
}

Judgement judge(const HistorySeries& series, const Place& place, double tail) {
  const ComparedPoints points = compared_points(series);
  const std::span<const double> level =
      std::span<const double>(points.values).subspan(place.level, place.base + 1 - place.level);
  Judgement judged{points.values[place.base], points.values[place.head], points.relative};
  const bool is_time =
      series.key.measure == reports::Measure::processor_seconds || series.key.measure == reports::Measure::wall_seconds;
  const bool repeats = level.size() > 1 && exact_changes(level).empty();
  if (repeats) {
    judged.is_known = true;
  } else if (level.size() >= least_commits) {
    const auto count = static_cast<double>(level.size());
    judged.before = mean_of(level);
    judge_by(judged, std::sqrt(sample_variance(level) * (1 + 1 / count)), count - 1, tail);
  }
  const auto &own_base = points.own_errors[place.base], &own_head = points.own_errors[place.head];
  if (own_base && own_head && (judged.is_known || !is_time)) {
    const int images = series.points[place.base].seeds + series.points[place.head].seeds;
    judge_by(judged, std::hypot(*own_base, *own_head), std::max(1, images - 2), tail);
  }
  if (!is_large(judged.after - judged.before, points.relative)) judged.exceeds = false;
  return judged;
}

void add_gate(HistoryComparison& comparison, const HistorySeries& series, const Place& place) {
  const auto &base = series.points[place.base].verdict, &head = series.points[place.head].verdict;
  if (head != base || head != GateVerdict::pass) comparison.gates.push_back({series.key, base, head});
}

void add_change(HistoryComparison& comparison, const HistorySeries& series, const Judgement& judged) {
  const reports::HistoryStep step =
      step_between(judged.before, judged.after, judged.standard_error, judged.quantile, judged.relative);
  comparison.changes.push_back(
      {series.key, is_worse(series.key, step) ? reports::ChangeSide::worse : reports::ChangeSide::better, step});
}

}  // namespace

std::size_t find_commit(const reports::History& history, const std::string& where, const std::string& name) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < history.commits.size(); ++i) {
    if (history.commits[i].name == name) return i;
    if (!name.empty() && history.commits[i].name.starts_with(name)) found.push_back(i);
  }
  if (found.size() == 1) return found.front();
  if (found.empty()) throw InputError(where, "the history has no commit '" + name + "'");
  throw InputError(where, "'" + name + "' is the beginning of " + std::to_string(found.size()) + " commits");
}

HistoryComparison compare_commits(const reports::History& history, std::size_t base, std::size_t head) {
  HistoryComparison comparison;
  comparison.base = history.commits.at(base);
  comparison.head = history.commits.at(head);
  std::vector<std::pair<const HistorySeries*, Place>> both;
  for (const HistorySeries& series : history.series) {
    const auto at_base = point_at(series, base), at_head = point_at(series, head);
    if (at_base && !at_head) ++comparison.only_base;
    if (!at_base && at_head) ++comparison.only_head;
    if (!at_base || !at_head) continue;
    const Place place{*at_base, *at_head, level_start(series, *at_base, *at_head)};
    if (series.key.measure == reports::Measure::gate) add_gate(comparison, series, place);
    if (series.is_judged) both.emplace_back(&series, place);
  }
  const double tail = false_changes / 2 / static_cast<double>(std::max<std::size_t>(1, both.size()));
  for (const auto& [series, place] : both) {
    const Judgement judged = judge(*series, place, tail);
    ++(judged.is_known ? comparison.compared : comparison.undecided);
    if (judged.is_known && judged.exceeds) add_change(comparison, *series, judged);
  }
  std::ranges::stable_sort(comparison.changes, [](const HistoryChange& a, const HistoryChange& b) {
    if (a.side != b.side) return a.side == reports::ChangeSide::worse;
    return size_of(a.step) > size_of(b.step);
  });
  return comparison;
}

}  // namespace photonproof::inline harness_history
