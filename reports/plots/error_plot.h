// Plot of error against time: relMSE over seconds, both logarithmic. It shows the harness's curves over seeds with
// their intervals, else one line for each engine and seed.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "reports/view/view.h"

namespace photonproof::reports::inline reports_plots {

struct PlotPoint {
  double seconds = 0;
  double relmse = 0;
  std::optional<Interval> seconds_interval{}, relmse_interval{};
  std::string text{};  ///< what is said when one points at it: "photon, 64 spp: relMSE 0.0125 in 1.20 s"
};

struct PlotSeries {
  std::size_t engine = 0;         ///< index into View::engines, decides colour and marker
  std::vector<PlotPoint> points;  ///< positive and finite, by budget
  std::optional<double> slope{};  ///< of the harness's least squares line of log relMSE on log seconds
};

struct ErrorPlot {
  std::vector<PlotSeries> series;  ///< none is empty
  std::size_t left_out = 0;        ///< results that logarithmic axes cannot show: no time, no error or zero
  bool over_seeds = false;         ///< a point stands for all seeds of a budget, not for one
  Clock clock = Clock::wall;       ///< of all seconds
  std::vector<double> targets;     ///< relMSEs that the suite sets for the scene
};

ErrorPlot error_plot(const View& view, const SceneView& scene);

/// The drawing as an <svg> element of the page; texts of the record are escaped. Precondition: at least one series.
std::string error_plot_svg(const ErrorPlot& plot, const std::string& label);

}  // namespace photonproof::reports::inline reports_plots
