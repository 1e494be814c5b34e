#include "harness/history/history_steps.h"

#include <algorithm>
#include <cmath>

#include "harness/history/change_points.h"
#include "harness/statistics/statistics.h"

namespace photonproof::inline harness_history {
namespace {

using reports::HistorySeries;
using reports::HistoryStep;

constexpr double normal_975 = 1.96, normal_9995 = 3.29;

/// Means of each level without outliers, and the scatter that all levels share.
struct Levels {
  std::vector<double> means;
  std::vector<std::size_t> counts;
  std::vector<std::optional<double>> own;  ///< mean squared standard error over seeds
  double variance = 0;
  double freedom = 0;
};

Levels levels_between(const ComparedPoints& points, const std::vector<std::size_t>& starts) {
  std::vector<std::size_t> bounds{0};
  bounds.insert(bounds.end(), starts.begin(), starts.end());
  bounds.push_back(points.values.size());
  const std::span<const double> values = points.values;
  std::vector<double> residuals, distances;
  std::vector<double> medians;
  for (std::size_t i = 0; i + 1 < bounds.size(); ++i) {
    medians.push_back(median_of(values.subspan(bounds[i], bounds[i + 1] - bounds[i])));
    for (std::size_t k = bounds[i]; k < bounds[i + 1]; ++k) residuals.push_back(values[k] - medians.back());
  }
  for (const double residual : residuals) distances.push_back(std::abs(residual));
  const double bound = 3 * 1.4826 * median_of(distances);
  Levels levels;
  double squares = 0;
  for (std::size_t i = 0; i + 1 < bounds.size(); ++i) {
    const std::size_t count = bounds[i + 1] - bounds[i];
    std::vector<double> bounded;
    for (std::size_t k = bounds[i]; k < bounds[i + 1]; ++k) bounded.push_back(std::clamp(residuals[k], -bound, bound));
    const double mean = mean_of(bounded);
    for (const double value : bounded) squares += (value - mean) * (value - mean);
    levels.means.push_back(medians[i] + mean);
    levels.counts.push_back(count);
    levels.own.push_back(
        mean_square(std::span<const std::optional<double>>(points.own_errors).subspan(bounds[i], count)));
  }
  levels.freedom = static_cast<double>(values.size()) - static_cast<double>(levels.means.size());
  levels.variance = levels.freedom > 0 ? squares / levels.freedom : 0;
  return levels;
}

/// Squared standard error of the difference of two neighbouring levels over seeds; 0 where it is not known.
double own_square(const Levels& levels, std::size_t before) {
  return levels.own[before].value_or(0) + levels.own[before + 1].value_or(0);
}

/// Removes what is not to be named until nothing changes: the levels beside it then become one.
std::vector<std::size_t> named_starts(const ComparedPoints& points, std::vector<std::size_t> starts) {
  for (bool again = true; again;) {
    const Levels levels = levels_between(points, starts);
    std::vector<std::size_t> kept;
    for (std::size_t i = 0; i < starts.size(); ++i) {
      const double difference = levels.means[i + 1] - levels.means[i];
      if (is_large(difference, points.relative) &&
          std::abs(difference) > normal_9995 * std::sqrt(own_square(levels, i)))
        kept.push_back(starts[i]);
    }
    again = kept.size() < starts.size();
    starts = kept;
  }
  return starts;
}

void find_steps_of(HistorySeries& series) {
  const ComparedPoints points = compared_points(series);
  std::vector<std::size_t> starts;
  if (series.is_judged)
    starts = named_starts(points,
                          repeats_exactly(points.values) ? exact_changes(points.values) : change_points(points.values));
  const Levels levels = levels_between(points, starts);
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const auto before = static_cast<double>(levels.counts[i]), after = static_cast<double>(levels.counts[i + 1]);
    const double scatter = levels.variance * (1 / before + 1 / after);
    const bool by_scatter = scatter >= own_square(levels, i);
    const double quantile = by_scatter && levels.freedom > 0 ? student_975(levels.freedom) : normal_975;
    HistoryStep step = step_between(levels.means[i], levels.means[i + 1],
                                    std::sqrt(std::max(scatter, own_square(levels, i))), quantile, points.relative);
    step.point = starts[i];
    series.steps.push_back(step);
  }
  for (const double mean : levels.means) series.levels.push_back(points.relative ? std::exp(mean) : mean);
}

}  // namespace

ComparedPoints compared_points(const HistorySeries& series) {
  ComparedPoints points;
  points.relative = series.key.measure != reports::Measure::gate &&
                    std::ranges::all_of(series.points, [](const auto& point) { return point.value > 0; });
  for (const reports::HistoryPoint& point : series.points) {
    points.values.push_back(points.relative ? std::log(point.value) : point.value);
    std::optional<double> error;
    if (const auto& interval = point.interval; interval && (!points.relative || interval->low > 0)) {
      const double width = points.relative ? std::log(interval->high / interval->low) : interval->high - interval->low;
      if (std::isfinite(width) && width >= 0) error = width / 2 / normal_975;
    }
    points.own_errors.push_back(error);
  }
  return points;
}

std::optional<double> mean_square(std::span<const std::optional<double>> errors) {
  double squares = 0;
  int known = 0;
  for (const std::optional<double>& error : errors)
    if (error) {
      squares += *error * *error;
      ++known;
    }
  if (known == 0) return std::nullopt;
  return squares / known;
}

HistoryStep step_between(double before, double after, double standard_error, double quantile, bool relative) {
  HistoryStep step;
  const double difference = after - before, reach = quantile * standard_error;
  step.relative = relative;
  step.before = relative ? std::exp(before) : before;
  step.after = relative ? std::exp(after) : after;
  step.change = relative ? std::expm1(difference) : difference;
  if (reach > 0)
    step.interval = relative ? Interval{std::expm1(difference - reach), std::expm1(difference + reach)}
                             : Interval{difference - reach, difference + reach};
  return step;
}

bool is_large(double difference, bool relative) {
  return std::abs(difference) >= (relative ? std::log1p(least_relative_change) : least_difference);
}

void find_steps(reports::History& history) {
  for (HistorySeries& series : history.series) find_steps_of(series);
}

}  // namespace photonproof::inline harness_history
