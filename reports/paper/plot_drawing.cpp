// Plots of error against time as SVG and PDF: a panel of a column's width for each scene, two beside each other, and
// one legend below.
#include <algorithm>

#include "reports/paper/canvas.h"
#include "reports/paper/paper_formats.h"
#include "reports/paper/paper_plot.h"
#include "reports/paper/paper_words.h"
#include "reports/plots/log_axis.h"
#include "reports/view/numbers.h"
#include "reports/view/text.h"

namespace photonproof::inline reports_paper {
using namespace reports;

namespace {

constexpr double panel_width = 236, panel_height = 172, legend_line = 12;
// The frame of the axes inside a panel.
constexpr double frame_left = 44, frame_right = 230, frame_top = 16, frame_bottom = 140;

/// The axes of a panel whose corner is at (x, y).
struct Panel {
  double left, top;
  LogScale x, y;
};

Panel panel_of(const ErrorPlot& plot, double left, double top) {
  ValueRange seconds, errors;
  for (const PlotSeries& series : plot.series) {
    for (const PlotPoint& point : series.points) {
      seconds.hold(point.seconds);
      errors.hold(point.relmse);
      errors.hold(point.relmse_interval);
    }
    if (const auto fit = fitted_line(series))
      for (const double relmse : fit->relmse) errors.hold(relmse);
  }
  for (const double target : plot.targets) errors.hold(target);
  return {left, top, LogScale{log_axis(seconds.low, seconds.high), left + frame_left, left + frame_right},
          LogScale{log_axis(errors.low, errors.high), top + frame_bottom, top + frame_top}};
}

void draw_axes(Canvas& canvas, const Panel& panel, const PaperPlot& plot) {
  const double left = panel.left + frame_left, right = panel.left + frame_right;
  const double top = panel.top + frame_top, bottom = panel.top + frame_bottom;
  const Stroke grid{"D8D8D8", 0.4, {}};
  for (const double tick : panel.x.axis.ticks) {
    canvas.polyline({{panel.x(tick), top}, {panel.x(tick), bottom}}, grid);
    canvas.text(panel.x(tick), bottom + 10, significant(tick, 1), {.align = 0.5});
  }
  for (const double tick : panel.y.axis.ticks) {
    canvas.polyline({{left, panel.y(tick)}, {right, panel.y(tick)}}, grid);
    canvas.text(left - 4, panel.y(tick) + 2.6, significant(tick, 1), {.align = 1});
  }
  canvas.polyline({{left, top}, {left, bottom}, {right, bottom}}, {"000000", 0.7, {}});
  canvas.text((left + right) / 2, panel.top + 10, printable(plot.scene), {.size = 8.5, .align = 0.5, .bold = true});
  canvas.text((left + right) / 2, bottom + 23, time_axis_title(plot.plot.clock), {.align = 0.5});
  canvas.text(panel.left + 9, (top + bottom) / 2, "relMSE", {.align = 0.5, .upwards = true});
}

void draw_mark(Canvas& canvas, double x, double y, const MethodStyle& style) {
  constexpr double r = 2.7;
  switch (style.mark) {
    case 0:
      return canvas.disk(x, y, r - 0.2, style.color);
    case 1:
      return canvas.polygon({{x - r, y - r}, {x + r, y - r}, {x + r, y + r}, {x - r, y + r}}, style.color, 1);
    case 2:
      return canvas.polygon({{x, y - r - 0.8}, {x + r + 0.4, y + r - 0.4}, {x - r - 0.4, y + r - 0.4}}, style.color, 1);
    case 3:
      return canvas.polygon({{x, y - r - 1}, {x + r + 1, y}, {x, y + r + 1}, {x - r - 1, y}}, style.color, 1);
    default:
      return canvas.polygon({{x, y + r + 0.8}, {x + r + 0.4, y - r + 0.4}, {x - r - 0.4, y - r + 0.4}}, style.color, 1);
  }
}

void draw_series(Canvas& canvas, const Panel& panel, const PlotSeries& series) {
  const MethodStyle style = method_style(series.engine);
  Corners line;
  for (const auto& band : interval_bands(series)) {
    Corners corners;
    for (const auto& [seconds, relmse] : band) corners.push_back({panel.x(seconds), panel.y(relmse)});
    if (corners.size() > 2)
      canvas.polygon(corners, style.color, 0.2);
    else
      canvas.polyline(corners, {style.color, 0.8, {}});
  }
  if (const auto fit = fitted_line(series)) {
    line = {{panel.x(fit->seconds[0]), panel.y(fit->relmse[0])}, {panel.x(fit->seconds[1]), panel.y(fit->relmse[1])}};
  } else {
    for (const PlotPoint& point : series.points) line.push_back({panel.x(point.seconds), panel.y(point.relmse)});
  }
  if (line.size() > 1) canvas.polyline(line, {style.color, 1, style.dash});
  for (const PlotPoint& point : series.points) draw_mark(canvas, panel.x(point.seconds), panel.y(point.relmse), style);
}

void draw_panel(Canvas& canvas, const PaperPlot& plot, double left, double top) {
  const Panel panel = panel_of(plot.plot, left, top);
  draw_axes(canvas, panel, plot);
  for (const double target : plot.plot.targets) {
    const double y = panel.y(target);
    canvas.polyline({{left + frame_left, y}, {left + frame_right, y}}, {"707070", 0.7, {1, 1.5}});
    canvas.text(left + frame_right, y - 2, "target " + significant(target), {.size = 6.5, .align = 1});
  }
  for (const PlotSeries& series : plot.plot.series) draw_series(canvas, panel, series);
}

}  // namespace

void write_plot_drawing(const Results& results, const std::filesystem::path& out, const PaperOptions& options,
                        DrawingKind kind) {
  const View view = arrange(results);
  const std::vector<std::string> titles = method_titles(view);
  const std::vector<PaperPlot> plots = paper_plots(view, options);
  const std::vector<std::size_t> engines = plotted_engines(plots);
  const std::size_t columns = std::min<std::size_t>(2, plots.size());
  const std::size_t rows = (plots.size() + columns - 1) / columns;
  const std::size_t entries_a_line = 2 * columns, lines = (engines.size() + entries_a_line - 1) / entries_a_line;
  const double width = panel_width * static_cast<double>(columns);
  const double panels = panel_height * static_cast<double>(rows);
  draw_file(out, kind, width, panels + legend_line * static_cast<double>(lines) + 4, results.created,
            [&](Canvas& canvas) {
              for (std::size_t i = 0; i < plots.size(); ++i)
                draw_panel(canvas, plots[i], panel_width * static_cast<double>(i % columns),
                           panel_height * static_cast<double>(i / columns));
              for (std::size_t i = 0; i < engines.size(); ++i) {
                const MethodStyle style = method_style(engines[i]);
                const double x = 14 + panel_width / 2 * static_cast<double>(i % entries_a_line);
                const double y = panels + 6 + legend_line * static_cast<double>(i / entries_a_line);
                canvas.polyline({{x, y}, {x + 24, y}}, {style.color, 1, style.dash});
                draw_mark(canvas, x + 12, y, style);
                canvas.text(x + 28, y + 2.6, printable(titles[engines[i]]), {});
              }
            });
}

void write_svg_report(const Results& results, const std::filesystem::path&, const std::filesystem::path& out,
                      const PaperOptions& options) {
  write_plot_drawing(results, out, options, DrawingKind::svg);
}

void write_pdf_report(const Results& results, const std::filesystem::path&, const std::filesystem::path& out,
                      const PaperOptions& options) {
  write_plot_drawing(results, out, options, DrawingKind::pdf);
}

}  // namespace photonproof::inline reports_paper
