// Plot of error against time for a paper: what pgfplots, SVG and PDF draw, and the styles that they share.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "reports/paper/paper_options.h"
#include "reports/plots/error_plot.h"

namespace photonproof::inline reports_paper {

/// Style of a method. Marks and dashes tell methods apart on grey prints, colours on others.
struct MethodStyle {
  std::string color;         ///< "0072B2"
  int mark = 0;              ///< disk, square, triangle, diamond, triangle upside down
  std::vector<double> dash;  ///< lengths of line and gap in pt; empty is solid
};
MethodStyle method_style(std::size_t engine);

/// A straight line on logarithmic axes.
struct FittedLine {
  double seconds[2], relmse[2];
};
/// The harness's least squares line of log relMSE on log seconds between the first and the last point. It has the
/// record's slope and goes through the mean of the logarithms, as every such line does. None without a slope.
std::optional<FittedLine> fitted_line(const reports::PlotSeries& series);

/// Bands of 95 % intervals of relMSE, as corners in order around each. Points without an interval interrupt the band; a
/// point alone has its upper and lower end.
std::vector<std::vector<std::array<double, 2>>> interval_bands(const reports::PlotSeries& series);

struct PaperPlot {
  std::string scene;  ///< title
  reports::ErrorPlot plot;
};

/// The scenes that have something to plot, or the one that is asked for. Throws InputError if there is nothing.
std::vector<PaperPlot> paper_plots(const reports::View& view, const PaperOptions& options);

/// Engines of the plots, each once, as indices into View::engines.
std::vector<std::size_t> plotted_engines(const std::vector<PaperPlot>& plots);

/// "Wall-clock time in s" or "Processor time of all threads in s".
std::string time_axis_title(Clock clock);

}  // namespace photonproof::inline reports_paper
