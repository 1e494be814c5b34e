// Draws an error plot: grid, intervals, lines, then markers, so that nothing hides a marker.
#include <fmt/format.h>

#include <kainjow/mustache.hpp>

#include "reports/plots/error_plot.h"
#include "reports/plots/log_axis.h"
#include "reports/view/engine_style.h"
#include "reports/view/numbers.h"
#include "reports/view/text.h"

namespace photonproof::reports::inline reports_plots {
namespace {

// The drawing's box and the frame of the axes inside it, in SVG units; style.css has the sizes of text.
constexpr double width = 640, height = 400, frame_left = 82, frame_right = 624, frame_top = 12, frame_bottom = 348;

std::string grid(const LogScale& x, const LogScale& y, Clock clock) {
  std::string lines, labels;
  for (const double tick : x.axis.ticks) {
    lines += svg_line(x(tick), frame_top, x(tick), frame_bottom);
    labels += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>", x(tick),
                          frame_bottom + 20, significant(tick, 1));
  }
  for (const double tick : y.axis.ticks) {
    lines += svg_line(frame_left, y(tick), frame_right, y(tick));
    labels += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text>", frame_left - 8,
                          y(tick) + 4.5, significant(tick, 1));
  }
  const std::string frame = svg_line(frame_left, frame_top, frame_left, frame_bottom) +
                            svg_line(frame_left, frame_bottom, frame_right, frame_bottom);
  const double middle = (frame_top + frame_bottom) / 2;
  return "<g class=\"grid\">" + lines + "</g>\n<g class=\"frame\">" + frame + "</g>\n<g class=\"labels\">" + labels +
         fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{} seconds</text>",
                     (frame_left + frame_right) / 2, height - 8, clock == Clock::wall ? "wall-clock" : "processor") +
         fmt::format("<text transform=\"translate(13 {:.1f}) rotate(-90)\" text-anchor=\"middle\">relMSE</text></g>\n",
                     middle);
}

std::string intervals(const PlotSeries& series, const LogScale& x, const LogScale& y) {
  constexpr double cap = 4;
  std::string out;
  for (const PlotPoint& point : series.points) {
    const double px = x(point.seconds), py = y(point.relmse);
    if (const auto& interval = point.relmse_interval) {
      for (const double end : {y(interval->low), y(interval->high)}) {
        out += svg_line(px, py, px, end) + svg_line(px - cap, end, px + cap, end);
      }
    }
    if (const auto& interval = point.seconds_interval) {
      for (const double end : {x(interval->low), x(interval->high)}) {
        out += svg_line(px, py, end, py) + svg_line(end, py - cap, end, py + cap);
      }
    }
  }
  return out.empty() ? out : "<g class=\"intervals\">" + out + "</g>";
}

std::string curve(const PlotSeries& series, const LogScale& x, const LogScale& y) {
  std::string path, markers;
  for (const PlotPoint& point : series.points) {
    path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", x(point.seconds), y(point.relmse));
    const std::string text = kainjow::mustache::html_escape(printable(point.text));
    markers += fmt::format("<g class=\"point\" transform=\"translate({:.1f} {:.1f})\"><title>{}</title>{}</g>\n",
                           x(point.seconds) - 6, y(point.relmse) - 6, text, engine_style(series.engine).svg_shape);
  }
  return fmt::format("<g style=\"color:{}\">{}<path class=\"curve\" d=\"{}\"/>\n{}</g>\n", engine_color(series.engine),
                     intervals(series, x, y), path, markers);
}

}  // namespace

std::string error_plot_svg(const ErrorPlot& plot, const std::string& label) {
  ValueRange seconds, errors;
  for (const PlotSeries& series : plot.series) {
    for (const PlotPoint& point : series.points) {
      seconds.hold(point.seconds);
      seconds.hold(point.seconds_interval);
      errors.hold(point.relmse);
      errors.hold(point.relmse_interval);
    }
  }
  for (const double target : plot.targets) errors.hold(target);
  const LogScale x{log_axis(seconds.low, seconds.high), frame_left, frame_right};
  const LogScale y{log_axis(errors.low, errors.high), frame_bottom, frame_top};
  std::string out = fmt::format("<svg viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" aria-label=\"{}\">\n", width, height,
                                kainjow::mustache::html_escape(printable(label))) +
                    grid(x, y, plot.clock);
  for (const double target : plot.targets)
    out += fmt::format(
        "<g class=\"target\">{}<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"end\">target {}</text></g>\n",
        svg_line(frame_left, y(target), frame_right, y(target)), frame_right, y(target) - 5, significant(target));
  for (const PlotSeries& series : plot.series) out += curve(series, x, y);
  return out + "</svg>";
}

}  // namespace photonproof::reports::inline reports_plots
