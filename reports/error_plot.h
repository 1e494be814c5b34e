// The plot of error against time: relMSE over wall-clock seconds, both logarithmic, one line for each engine and seed.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "reports/view.h"

namespace photonproof::reports {

struct PlotPoint {
  double seconds = 0;
  double relmse = 0;
};

struct PlotSeries {
  std::size_t engine = 0;         ///< index into View::engines, decides colour and marker
  std::vector<PlotPoint> points;  ///< positive and finite, by budget
};

struct ErrorPlot {
  std::vector<PlotSeries> series;  ///< none is empty
  std::size_t left_out = 0;        ///< finished cells that logarithmic axes cannot show: no time, no error or zero
};

ErrorPlot error_plot(const SceneView& scene);

struct LogAxis {
  double low = 1, high = 10;  ///< both positive
  std::vector<double> ticks;  ///< inside [low, high], one significant digit each
};
/// A logarithmic axis with a margin around [smallest, largest], at least a factor of 4 long, and 2 to 10 round ticks.
LogAxis log_axis(double smallest, double largest);

/// The gnuplot script; it contains numbers only, no text from the record. Precondition: at least one series.
std::string gnuplot_script(const ErrorPlot& plot);

}  // namespace photonproof::reports
