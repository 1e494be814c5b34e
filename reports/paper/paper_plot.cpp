#include "reports/paper/paper_plot.h"

#include <algorithm>
#include <cmath>

#include "reports/paper/paper_words.h"
#include "reports/view/engine_style.h"
#include "scenes/base/input_error.h"

namespace photonproof::inline reports_paper {
using namespace reports;

MethodStyle method_style(std::size_t engine) {
  static const std::vector<double> dashes[] = {{}, {5, 2}, {1.2, 1.8}, {5, 1.8, 1.2, 1.8}, {9, 2.5}, {2.5, 2.5}};
  return {engine_style(engine).color + 1, static_cast<int>(engine % 5), dashes[engine % std::size(dashes)]};
}

std::optional<FittedLine> fitted_line(const PlotSeries& series) {
  if (!series.slope || series.points.size() < 2) return std::nullopt;
  double x = 0, y = 0;
  for (const PlotPoint& point : series.points) {
    x += std::log(point.seconds) / static_cast<double>(series.points.size());
    y += std::log(point.relmse) / static_cast<double>(series.points.size());
  }
  const auto [first, last] = std::ranges::minmax(series.points, {}, &PlotPoint::seconds);
  const auto at = [&](double seconds) { return std::exp(y + *series.slope * (std::log(seconds) - x)); };
  return FittedLine{{first.seconds, last.seconds}, {at(first.seconds), at(last.seconds)}};
}

std::vector<std::vector<std::array<double, 2>>> interval_bands(const PlotSeries& series) {
  std::vector<PlotPoint> points = series.points;
  std::ranges::stable_sort(points, {}, &PlotPoint::seconds);
  std::vector<std::vector<std::array<double, 2>>> bands;
  for (std::size_t begin = 0; begin < points.size();) {
    std::size_t end = begin;
    while (end < points.size() && points[end].relmse_interval) ++end;
    if (end > begin) {
      auto& band = bands.emplace_back();
      for (std::size_t i = begin; i < end; ++i) band.push_back({points[i].seconds, points[i].relmse_interval->high});
      for (std::size_t i = end; i-- > begin;) band.push_back({points[i].seconds, points[i].relmse_interval->low});
    }
    begin = end + 1;
  }
  return bands;
}

std::vector<PaperPlot> paper_plots(const View& view, const PaperOptions& options) {
  std::vector<PaperPlot> plots;
  const auto add = [&](const SceneView& scene) {
    ErrorPlot plot = error_plot(view, scene);
    if (!plot.series.empty()) plots.push_back({scene_title(scene.record), std::move(plot)});
  };
  if (!options.scene.empty())
    add(scene_of(view, options.scene));
  else
    for (const SceneView& scene : view.scenes) add(scene);
  if (plots.empty())
    throw InputError(options.scene.empty() ? "the record" : options.scene,
                     "has no error above zero with a time, so there is nothing to plot");
  return plots;
}

std::vector<std::size_t> plotted_engines(const std::vector<PaperPlot>& plots) {
  std::vector<std::size_t> engines;
  for (const PaperPlot& plot : plots)
    for (const PlotSeries& series : plot.plot.series)
      if (std::ranges::find(engines, series.engine) == engines.end()) engines.push_back(series.engine);
  std::ranges::sort(engines);
  return engines;
}

std::string time_axis_title(Clock clock) {
  return clock == Clock::wall ? "Wall-clock time in s" : "Processor time of all threads in s";
}

}  // namespace photonproof::inline reports_paper
