#include "reports/grades/grade_plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <kainjow/mustache.hpp>
#include <vector>

#include "reports/grades/grade_words.h"
#include "reports/plots/log_axis.h"
#include "reports/view/engine_style.h"
#include "reports/view/numbers.h"
#include "reports/view/text.h"

namespace photonproof::reports::inline reports_grades {
namespace {

// In SVG units; style.css has the sizes of text.
constexpr double plot_width = 480, plot_left = 58, plot_right = 468;

std::string safe_text(const std::string& text) { return kainjow::mustache::html_escape(printable(text)); }

std::string svg_text(double x, double y, const char* anchor, const std::string& text) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>", x, y, anchor, safe_text(text));
}

std::string svg_begin(double height, const std::string& label) {
  return fmt::format("<svg viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" aria-label=\"{}\">\n", plot_width, height,
                     safe_text(label));
}

/// A marker that shows `text` under the pointer.
std::string svg_point(double x, double y, PlotRole role, const std::string& text) {
  return fmt::format(
      "<svg class=\"point\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"12\" height=\"12\" overflow=\"visible\"><title>{}</title>"
      "{}</svg>\n",
      x - 6, y - 6, safe_text(text), role_style(role).shape);
}

std::string svg_bar(double x, double y, double width, double height, const std::string& text) {
  return fmt::format(
      "<g class=\"point\"><title>{}</title><rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"/></g>\n",
      safe_text(text), x, y, width, height);
}

std::string in_role(PlotRole role, const std::string& drawing) {
  return fmt::format("<g style=\"color:{}\">{}</g>\n", role_style(role).color, drawing);
}

bool is_drawable(double value) { return std::isfinite(value) && value > 0; }

/// An interval along x with caps at its ends.
std::string svg_interval(const std::optional<Interval>& interval, const LogScale& x, double y) {
  constexpr double cap = 4;
  if (!interval || !is_drawable(interval->low) || !is_drawable(interval->high)) return {};
  const double low = x(interval->low), high = x(interval->high);
  return "<g class=\"intervals\">" + svg_line(low, y, high, y) + svg_line(low, y - cap, low, y + cap) +
         svg_line(high, y - cap, high, y + cap) + "</g>";
}

// --- rounds ---

constexpr double rounds_top = 14, rounds_bottom = 168, busy_top = 190, busy_bottom = 226, rounds_height = 262;

double round_x(std::size_t round, std::size_t rounds) {
  return plot_left + (plot_right - plot_left) * (static_cast<double>(round) + 0.5) / static_cast<double>(rounds);
}

std::string round_series(const std::vector<double>& seconds, std::size_t rounds, const LogScale& y, PlotRole role,
                         const char* whose) {
  std::string path, points;
  for (std::size_t i = 0; i < seconds.size(); ++i) {
    if (!is_drawable(seconds[i])) continue;
    const double px = round_x(i, rounds), py = y(seconds[i]);
    path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", px, py);
    points += svg_point(px, py, role, fmt::format("round {}, {}: {} s", i + 1, whose, significant(seconds[i])));
  }
  return in_role(role, "<path class=\"curve\" d=\"" + path + "\"/>\n" + points);
}

std::string rounds_frame(std::size_t rounds, const LogScale& y, double most_busy) {
  std::string lines, labels;
  for (const double tick : y.axis.ticks) {
    lines += svg_line(plot_left, y(tick), plot_right, y(tick));
    labels += svg_text(plot_left - 8, y(tick) + 4.5, "end", significant(tick, 1));
  }
  const std::size_t step = (rounds + 11) / 12;
  for (std::size_t i = 0; i < rounds; i += step)
    labels += svg_text(round_x(i, rounds), busy_bottom + 17, "middle", std::to_string(i + 1));
  labels += svg_text((plot_left + plot_right) / 2, rounds_height - 3, "middle", "round");
  labels += svg_text(plot_left - 8, busy_top + 9, "end", significant(most_busy, 2));
  labels += svg_text(plot_left + 4, busy_top - 5, "start", "cores busy with other work");
  labels += fmt::format("<text transform=\"translate(13 {:.1f}) rotate(-90)\" text-anchor=\"middle\">seconds</text>",
                        (rounds_top + rounds_bottom) / 2);
  return "<g class=\"grid\">" + lines + "</g>\n<g class=\"frame\">" +
         svg_line(plot_left, rounds_top, plot_left, rounds_bottom) +
         svg_line(plot_left, rounds_bottom, plot_right, rounds_bottom) +
         svg_line(plot_left, busy_bottom, plot_right, busy_bottom) + "</g>\n<g class=\"labels\">" + labels + "</g>\n";
}

std::string busy_bars(const std::vector<double>& busy, std::size_t rounds, double most_busy) {
  const double width = std::min(24.0, 0.6 * (plot_right - plot_left) / static_cast<double>(rounds));
  std::string bars;
  for (std::size_t i = 0; i < busy.size(); ++i) {
    const double height = (busy_bottom - busy_top) * std::clamp(busy[i] / most_busy, 0.0, 1.0);
    bars += svg_bar(round_x(i, rounds) - width / 2, busy_bottom - height, width, height,
                    fmt::format("round {}: others keep {} cores busy", i + 1, significant(busy[i], 2)));
  }
  return in_role(PlotRole::noise, bars);
}

// --- speed-ups ---

bool has_speed(const SubmissionGrade& submission) {
  return !submission.speed.scenes.empty() && is_drawable(submission.speed.speedup.value);
}

std::vector<SpeedTier> tiers_to_draw(const Grades& grades) {
  std::vector<SpeedTier> tiers = grades.speed_tiers;
  if (grades.speed_curve) tiers.push_back(*grades.speed_curve);
  return tiers;
}

LogScale speed_scale(const Grades& grades, const std::vector<const Estimate*>& speedups, double left) {
  ValueRange range;
  range.hold(1.0);
  for (const SpeedTier& tier : tiers_to_draw(grades))
    if (is_drawable(tier.ratio)) range.hold(tier.ratio);
  for (const Estimate* speedup : speedups) {
    range.hold(speedup->value);
    if (speedup->interval && is_drawable(speedup->interval->low)) range.hold(speedup->interval);
  }
  return {log_axis(range.low, range.high), left, plot_right};
}

std::string speed_frame(const Grades& grades, const LogScale& x, double top, double bottom) {
  std::string tiers, labels, last_labels;
  double last_x = -100;
  for (const SpeedTier& tier : tiers_to_draw(grades)) {
    const double px = x(tier.ratio);
    tiers += svg_line(px, top, px, bottom);
    if (px - last_x < 34) continue;  // its text would overlap the last one
    last_x = px;
    last_labels += svg_text(px, top - 6, "middle", points_text(tier.points) + " p");
  }
  for (const double tick : x.axis.ticks) labels += svg_text(x(tick), bottom + 18, "middle", significant(tick, 1) + "×");
  return "<g class=\"target\">" + tiers + last_labels + "</g>\n<g class=\"frame\">" +
         svg_line(x.from, bottom, x.to, bottom) + "</g>\n<g class=\"labels\">" + labels + "</g>\n";
}

std::string short_name(const std::string& name) {
  constexpr std::size_t most = 18;
  const std::string text = printable(name);
  return text.size() <= most ? text : shortened(text, most - 1) + "…";
}

}  // namespace

RoleStyle role_style(PlotRole role) {
  if (role == PlotRole::noise) return {"var(--quiet)", "<rect x=\"2\" y=\"2\" width=\"8\" height=\"8\"/>"};
  const std::size_t index = role == PlotRole::baseline ? 0 : 1;
  return {engine_color(index), engine_style(index).svg_shape};
}

std::string rounds_plot_svg(const SceneSpeed& speed, const std::string& label) {
  ValueRange range;
  for (const auto* seconds : {&speed.baseline_seconds, &speed.seconds})
    for (const double value : *seconds)
      if (is_drawable(value)) range.hold(value);
  const std::size_t rounds = std::max(speed.baseline_seconds.size(), speed.seconds.size());
  if (range.high <= 0) return {};
  const LogScale y{log_axis(range.low, range.high), rounds_bottom, rounds_top};
  double most_busy = 1;
  for (const double busy : speed.busy) most_busy = std::max(most_busy, busy);
  return svg_begin(rounds_height, label) + rounds_frame(rounds, y, most_busy) +
         busy_bars(speed.busy, rounds, most_busy) +
         round_series(speed.baseline_seconds, rounds, y, PlotRole::baseline, "the baseline") +
         round_series(speed.seconds, rounds, y, PlotRole::own, "the submission") + "</svg>";
}

std::string tiers_plot_svg(const Grades& grades, const Estimate& speedup, const std::string& label) {
  if (!is_drawable(speedup.value)) return {};
  constexpr double top = 24, bottom = 56, height = 80;
  const LogScale x = speed_scale(grades, {&speedup}, 16);
  const double y = (top + bottom) / 2;
  return svg_begin(height, label) + speed_frame(grades, x, top, bottom) +
         in_role(PlotRole::own, svg_interval(speedup.interval, x, y) +
                                    svg_point(x(speedup.value), y, PlotRole::own, speed_text(speedup))) +
         "</svg>";
}

std::string class_speeds_svg(const Grades& grades) {
  constexpr double top = 24, row_height = 20, name_width = 150;
  std::vector<const SubmissionGrade*> rows;
  for (const SubmissionGrade& submission : grades.submissions)
    if (has_speed(submission)) rows.push_back(&submission);
  if (rows.empty()) return {};
  std::ranges::stable_sort(rows, [](const SubmissionGrade* a, const SubmissionGrade* b) {
    return a->speed.speedup.value > b->speed.speedup.value;
  });
  std::vector<const Estimate*> speedups;
  for (const SubmissionGrade* row : rows) speedups.push_back(&row->speed.speedup);
  const LogScale x = speed_scale(grades, speedups, name_width);
  const double bottom = top + row_height * static_cast<double>(rows.size());
  std::string drawing, names;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double y = top + row_height * (static_cast<double>(i) + 0.5);
    const SpeedGrade& speed = rows[i]->speed;
    names += svg_text(name_width - 10, y + 4.5, "end", short_name(rows[i]->name));
    const std::string noisy = speed.state == SpeedGrade::State::too_noisy ? ", too noisy" : "";
    drawing += svg_interval(speed.speedup.interval, x, y) +
               svg_point(x(speed.speedup.value), y, noisy.empty() ? PlotRole::baseline : PlotRole::own,
                         rows[i]->name + ": " + speed_text(speed.speedup) + noisy);
  }
  return svg_begin(bottom + 30, "Speed-ups of the class") + speed_frame(grades, x, top, bottom) +
         "<g class=\"labels\">" + names + "</g>\n" + in_role(PlotRole::baseline, drawing) + "</svg>";
}

std::string class_points_svg(const Grades& grades) {
  constexpr std::size_t bins = 10;
  constexpr double top = 22, bottom = 170, height = 214;
  std::vector<std::size_t> count(bins, 0);
  const double most = grades.max_points();
  if (most <= 0) return {};
  for (const SubmissionGrade& submission : grades.submissions) {
    const double bin = std::floor(bins * submission.points() / most);
    ++count[static_cast<std::size_t>(std::clamp(bin, 0.0, bins - 1.0))];
  }
  const auto highest = static_cast<double>(std::max<std::size_t>(1, *std::ranges::max_element(count)));
  const double width = (plot_right - 16) / bins;
  std::string bars, labels;
  for (std::size_t i = 0; i < bins; ++i) {
    const double x = 16 + width * static_cast<double>(i),
                 tall = (bottom - top) * static_cast<double>(count[i]) / highest;
    const std::string from = points_text(most * static_cast<double>(i) / bins),
                      to = points_text(most * static_cast<double>(i + 1) / bins);
    bars += svg_bar(x + 2, bottom - tall, width - 4, tall, fmt::format("{} with {} to {} points", count[i], from, to));
    if (count[i] > 0) labels += svg_text(x + width / 2, bottom - tall - 6, "middle", std::to_string(count[i]));
    labels += svg_text(x, bottom + 18, "middle", from);
  }
  labels += svg_text(plot_right + 10, bottom + 18, "end", points_text(most)) +
            svg_text((16 + plot_right) / 2, height - 4, "middle", "points");
  return svg_begin(height, "Points of the class") + in_role(PlotRole::baseline, bars) + "<g class=\"frame\">" +
         svg_line(16, bottom, plot_right, bottom) + "</g>\n<g class=\"labels\">" + labels + "</g></svg>";
}

}  // namespace photonproof::reports::inline reports_grades
