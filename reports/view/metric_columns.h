// The metrics in a table, in its order: one row per column. Other metrics of a cell are in its details.
#pragma once

#include <span>
#include <string>

namespace photonproof::reports::inline reports_view {

struct MetricColumn {
  const char* metric;   ///< its name in results.json
  const char* title;    ///< of the column
  const char* meaning;  ///< one sentence for the page's notes
  std::string (*format)(double);
};

std::span<const MetricColumn> metric_columns();

/// A metric's number as in its column; three significant digits if it has no column.
std::string format_metric(const std::string& metric, double value);

}  // namespace photonproof::reports::inline reports_view
