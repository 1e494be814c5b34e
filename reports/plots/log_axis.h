// A logarithmic axis of a drawing in SVG.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reports/record/results.h"

namespace photonproof::reports::inline reports_plots {

struct LogAxis {
  double low = 1, high = 10;  ///< both positive
  std::vector<double> ticks;  ///< inside [low, high], one significant digit each
};
/// A logarithmic axis with a margin around [smallest, largest], at least a factor of 4 long, and 2 to 10 round ticks.
LogAxis log_axis(double smallest, double largest);

/// Maps an axis to coordinates of the drawing.
struct LogScale {
  LogAxis axis;
  double from = 0, to = 1;  ///< where axis.low and axis.high are drawn
  double operator()(double value) const;
};

/// The range of values that an axis shows.
struct ValueRange {
  double low = 1e300, high = 0;
  void hold(double value);
  void hold(const std::optional<Interval>& interval);
};

/// A straight <path>.
std::string svg_line(double x1, double y1, double x2, double y2);

}  // namespace photonproof::reports::inline reports_plots
