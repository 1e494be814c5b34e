// Steps of a history's series, with their sizes and intervals.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "reports/history/history_view.h"

namespace photonproof::inline harness_history {

/// Smaller changes are not named: a part of the value, or for quantities of either sign the difference.
inline constexpr double least_relative_change = 0.01, least_difference = 0.001;

/// Points of a series on the scale on which they are compared: logarithms if all values are positive.
struct ComparedPoints {
  bool relative = true;
  std::vector<double> values;
  /// Standard error of each value over its seeds, on the same scale. Points of one program with the same seeds share
  /// that error, so it does not average out over commits.
  std::vector<std::optional<double>> own_errors;
};
ComparedPoints compared_points(const reports::HistorySeries& series);

/// Mean of the squared standard errors that are known; absent if none is.
std::optional<double> mean_square(std::span<const std::optional<double>> errors);

/// The step between two levels on that scale, in a series' units.
reports::HistoryStep step_between(double before, double after, double standard_error, double quantile, bool relative);

/// Whether a difference on that scale is large enough to be named.
bool is_large(double difference, bool relative);

/// Finds the steps of all judged series (change_points.h) and sets their levels. A step that the errors over seeds
/// explain, at 3.29 standard errors (two-sided 0.001), is left out, and so is one that is not large.
void find_steps(reports::History& history);

}  // namespace photonproof::inline harness_history
