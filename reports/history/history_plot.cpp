#include "reports/history/history_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <kainjow/mustache.hpp>
#include <vector>

#include "reports/history/history_words.h"
#include "reports/plots/log_axis.h"
#include "reports/view/numbers.h"
#include "reports/view/text.h"

namespace photonproof::reports::inline reports_history {
namespace {

// The drawing's box and the frame inside it, in SVG units.
constexpr double width = 360, height = 176, left = 70, right = 350, top = 24, bottom = 150;
// Values that span more than this factor have a logarithmic axis.
constexpr double longest_linear = 10;

std::string escaped(const std::string& text) { return kainjow::mustache::html_escape(printable(text)); }

/// Least, median and largest value of neighbouring points.
struct Marker {
  std::size_t first = 0, last = 0;  ///< points
  double low = 0, middle = 0, high = 0;
  bool fails = false;
};

std::vector<Marker> markers_of(const HistorySeries& series, std::size_t most) {
  const std::size_t together = (series.points.size() + most - 1) / most;
  std::vector<Marker> markers;
  for (std::size_t first = 0; first < series.points.size(); first += together) {
    Marker marker{first, std::min(first + together, series.points.size()) - 1};
    std::vector<double> values;
    for (std::size_t i = marker.first; i <= marker.last; ++i) {
      values.push_back(series.points[i].value);
      marker.fails = marker.fails || series.points[i].verdict == GateVerdict::fail;
    }
    std::ranges::sort(values);
    marker.low = values.front();
    marker.middle = values[values.size() / 2];
    marker.high = values.back();
    markers.push_back(marker);
  }
  return markers;
}

/// Maps values to the frame, and has round ticks. Positions are fractions of halves or of logarithms, so they are
/// finite for every range of double.
class ValueAxis {
 public:
  ValueAxis(double low, double high) {
    const bool is_long = low > 0 && std::log(high) - std::log(low) > std::log(longest_linear);
    is_long ? set_logarithmic(low, high) : set_linear(low, high);
  }
  double operator()(double value) const {
    const double part = (scaled(value) - low_) / (high_ - low_);
    return bottom + std::clamp(part, 0.0, 1.0) * (top - bottom);
  }
  std::vector<double> ticks;

 private:
  double scaled(double value) const { return logarithmic_ ? std::log(value) : value / 2; }
  void set_logarithmic(double low, double high) {
    constexpr double most_decades = 100;
    logarithmic_ = true;
    const double margin = 0.06 * (std::log(high) - std::log(low));
    low_ = std::log(low) - margin;
    high_ = std::log(high) + margin;
    ticks = {low, high};
    if (high_ - low_ > most_decades * std::log(10.0)) return;
    const std::vector<double> round = log_axis(low, high).ticks;
    if (round.size() > 2) ticks = {round.front(), round[round.size() / 2], round.back()};
  }
  void set_linear(double low, double high) {
    const double middle = low / 4 + high / 4;
    const double reach = std::max({(high / 4 - low / 4) * 1.15, std::abs(middle) * 0.03, 1e-300});
    low_ = middle - reach;
    high_ = middle + reach;
    const double power = std::pow(10.0, std::floor(std::log10(reach)));
    const double parts = reach / power;
    const double step = power * (parts > 5 ? 5 : parts > 2 ? 2 : 1);
    for (double tick = std::ceil(low_ / step) * step; tick <= high_ && ticks.size() < 6; tick += step)
      if (std::isfinite(2 * tick)) ticks.push_back(std::abs(tick) < step * 1e-6 ? 0 : 2 * tick);
  }
  bool logarithmic_ = false;
  double low_ = 0, high_ = 1;  // on the scale of `scaled`
};

class Plot {
 public:
  Plot(const History& history, const HistorySeries& series, std::size_t most)
      : history_(history), series_(series), markers_(markers_of(series, most)), y_(axis_of(markers_)) {}

  std::string svg() const {
    const std::string label = fmt::format("{}, {}, {} over {} commits", subject_text(series_.key), series_.key.budget,
                                          series_.key.size, series_.points.size());
    return fmt::format("<svg viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" aria-label=\"{}\">", width, height,
                       escaped(label)) +
           grid() + levels() + values() + steps() + "</svg>";
  }

 private:
  static ValueAxis axis_of(const std::vector<Marker>& markers) {
    double low = markers.front().low, high = markers.front().high;
    for (const Marker& marker : markers) {
      low = std::min(low, marker.low);
      high = std::max(high, marker.high);
    }
    return {low, high};
  }
  double x_of(std::size_t commit) const {
    const double last = std::max<double>(1, static_cast<double>(history_.commits.size()) - 1);
    return left + 8 + (right - left - 16) * static_cast<double>(commit) / last;
  }
  double x(std::size_t point) const { return x_of(series_.points[point].commit); }
  std::string name(std::size_t point) const { return commit_text(history_.commits[series_.points[point].commit].name); }

  std::string grid() const {
    std::string lines, labels;
    for (const double tick : y_.ticks) {
      lines += svg_line(left, y_(tick), right, y_(tick));
      labels += fmt::format("<text x=\"{:.0f}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text>", left - 6, y_(tick) + 4,
                            escaped(value_text(series_.key, tick)));
    }
    const auto commit_label = [&](double at, const char* anchor, const HistoryCommit& commit) {
      labels += fmt::format("<text x=\"{:.0f}\" y=\"{:.0f}\" text-anchor=\"{}\">{}</text>", at, bottom + 18, anchor,
                            escaped(shortened(commit_text(commit.name), 18)));
    };
    commit_label(left, "start", history_.commits.front());
    if (history_.commits.size() > 1) commit_label(right, "end", history_.commits.back());
    return "<g class=\"grid\">" + lines + "</g><g class=\"frame\">" + svg_line(left, bottom, right, bottom) +
           "</g><g class=\"labels\">" + labels + "</g>";
  }
  std::string levels() const {
    std::string lines;
    for (std::size_t i = 0; series_.is_judged && i < series_.levels.size(); ++i) {
      const std::size_t first = i == 0 ? 0 : series_.steps[i - 1].point;
      const std::size_t last = i < series_.steps.size() ? series_.steps[i].point - 1 : series_.points.size() - 1;
      lines += svg_line(x(first), y_(series_.levels[i]), x(last), y_(series_.levels[i]));
    }
    return "<g class=\"level\">" + lines + "</g>";
  }
  std::string marker_text(const Marker& marker) const {
    if (marker.first == marker.last) {
      const HistoryPoint& point = series_.points[marker.first];
      return name(marker.first) + ": " + value_text(series_.key, point.value) +
             (point.verdict ? ", " + to_string(*point.verdict) : "");
    }
    return fmt::format("{} to {}: {}, from {} to {}", name(marker.first), name(marker.last),
                       value_text(series_.key, marker.middle), value_text(series_.key, marker.low),
                       value_text(series_.key, marker.high));
  }
  std::string values() const {
    std::string ranges, points;
    for (const Marker& marker : markers_) {
      const double at = (x(marker.first) + x(marker.last)) / 2;
      if (marker.high > marker.low) ranges += svg_line(at, y_(marker.low), at, y_(marker.high));
      points += fmt::format("<g class=\"point{}\"><title>{}</title><circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2.5\"/></g>",
                            marker.fails ? " fails" : "", escaped(marker_text(marker)), at, y_(marker.middle));
    }
    return "<g class=\"intervals\">" + ranges + "</g>" + points;
  }
  /// The newest steps have names, as far as these do not overlap.
  std::string steps() const {
    std::string out;
    double free = width;
    for (std::size_t i = series_.steps.size(); i-- > 0;) {
      const HistoryStep& step = series_.steps[i];
      const double at = (x(step.point - 1) + x(step.point)) / 2;
      const std::string text = step_text(step);
      const double half = 3.4 * static_cast<double>(text.size()) + 4, middle = std::clamp(at, half, width - half);
      out += fmt::format("<g class=\"step {}\">{}", is_worse(series_.key, step) ? "worse" : "better",
                         svg_line(at, top - 6, at, bottom));
      if (middle + half <= free) {
        out += fmt::format("<text x=\"{:.1f}\" y=\"{:.0f}\" text-anchor=\"middle\">{}</text>", middle, top - 11,
                           escaped(text));
        free = middle - half;
      }
      out += "</g>";
    }
    return out;
  }
  std::string step_text(const HistoryStep& step) const {
    const std::string change = step.relative ? (step.change > 0 ? "+" : "") + significant(100 * step.change, 2) + " %"
                                             : "to " + value_text(series_.key, step.after);
    return shortened(name(step.point), 18) + " " + change;
  }

  const History& history_;
  const HistorySeries& series_;
  std::vector<Marker> markers_;
  ValueAxis y_;
};

}  // namespace

std::string history_plot_svg(const History& history, const HistorySeries& series, std::size_t markers) {
  return Plot(history, series, std::max<std::size_t>(1, markers)).svg();
}

}  // namespace photonproof::reports::inline reports_history
