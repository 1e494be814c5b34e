#include "harness/conclusions/error_curve.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace photonproof::inline harness_conclusions {
namespace {

// An error is unknown if it grows with the budget by more than this factor.
constexpr double tolerated_growth = 2;

using Points = std::vector<const ConvergencePoint*>;

// A place on the line between two points in logarithms. At a point itself both are that point.
struct Place {
  const ConvergencePoint* from = nullptr;
  const ConvergencePoint* to = nullptr;
  double share = 0;  // of the way to `to`
};

Place at_point(const ConvergencePoint* point) { return {point, point, 0}; }

// Logarithmic distances of an estimate from the ends of its interval; infinite where it is not known.
struct Margin {
  double down = std::numeric_limits<double>::infinity(), up = down;
};

Margin margin_of(double value, const std::optional<Interval>& interval) {
  if (!interval || interval->low <= 0) return {};
  return {std::log(value / interval->low), std::log(interval->high / value)};
}

double log_ratio(double a, double b) { return std::log(a / b); }

double interpolated(double from, double to, double share) { return from * std::pow(to / from, share); }

// The last place at which the error comes down to `relmse`; `points` ascend in seconds.
std::optional<Place> place_of_error(const Points& points, double relmse) {
  std::size_t below = points.size();  // all points from this one on are below it
  while (below > 0 && points[below - 1]->relmse->value <= relmse) --below;
  if (below == points.size()) return std::nullopt;
  if (below == 0) {
    if (points[0]->relmse->value != relmse) return std::nullopt;
    return at_point(points[0]);
  }
  const ConvergencePoint *from = points[below - 1], *to = points[below];
  return Place{from, to, log_ratio(from->relmse->value, relmse) / log_ratio(from->relmse->value, to->relmse->value)};
}

std::optional<Place> place_of_time(const Points& points, double seconds) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i]->seconds.value == seconds) return at_point(points[i]);
    if (i > 0 && points[i - 1]->seconds.value < seconds && seconds < points[i]->seconds.value)
      return Place{points[i - 1], points[i],
                   log_ratio(seconds, points[i - 1]->seconds.value) /
                       log_ratio(points[i]->seconds.value, points[i - 1]->seconds.value)};
  }
  return std::nullopt;
}

// d ln error / d ln time over all points, since a slope between two noisy points is itself noise. Plain Monte Carlo's
// where a single time gives none.
double slope_of(const KnownPoints& curve) {
  const auto fit = fit_in_logarithms(curve);
  return fit ? fit->slope : -1;
}

// The interval of a value at a place: that of the errors times `by_relmse` and that of the times times `by_seconds`,
// the derivatives of the value's logarithm, in quadrature. Between two points each half-width is interpolated, as if
// both erred together. Empty where a point's interval is not known.
std::optional<Interval> interval_at(const Place& place, double value, double by_relmse, double by_seconds) {
  const auto margin_at = [&](auto margin) {
    const Margin from = margin(*place.from);
    if (place.share == 0) return from;
    const Margin to = margin(*place.to);
    return Margin{std::lerp(from.down, to.down, place.share), std::lerp(from.up, to.up, place.share)};
  };
  double down = 0, up = 0;
  const auto add = [&](const Margin& margin, double derivative) {
    down = std::hypot(down, std::abs(derivative) * (derivative < 0 ? margin.up : margin.down));
    up = std::hypot(up, std::abs(derivative) * (derivative < 0 ? margin.down : margin.up));
  };
  add(margin_at([](const ConvergencePoint& p) { return margin_of(p.relmse->value, relmse_interval(p)); }), by_relmse);
  add(margin_at([](const ConvergencePoint& p) { return margin_of(p.seconds.value, p.seconds.interval); }), by_seconds);
  if (!std::isfinite(down) || !std::isfinite(up)) return std::nullopt;
  return Interval{value * std::exp(-down), value * std::exp(up)};
}

}  // namespace

bool has_own_error(const ConvergencePoint& point) {
  return point.relmse && point.relmse->value > 0 && point.seconds.value > 0 && !point.undefined.contains(own_error_key);
}

std::optional<Interval> relmse_interval(const ConvergencePoint& point) {
  return point.relmse && point.relmse->interval ? point.relmse->interval : point.spread_of_seeds;
}

KnownPoints known_points(const Convergence& curve) {
  KnownPoints known;
  const ConvergencePoint* least = nullptr;
  std::size_t behind_leap = 0;
  for (const ConvergencePoint& point : curve.points) {
    if (!has_own_error(point)) continue;
    known.points.push_back(&point);
    if (least != nullptr && point.relmse->value > tolerated_growth * least->relmse->value) {
      behind_leap = known.points.size();
      known.leap = fmt::format("error grows from {:.2g} at {} to {:.2g} at {}", least->relmse->value,
                               least->budget.label(), point.relmse->value, point.budget.label());
      least = nullptr;
    }
    if (least == nullptr || point.relmse->value < least->relmse->value) least = &point;
  }
  known.points.erase(known.points.begin(), known.points.begin() + static_cast<std::ptrdiff_t>(behind_leap));
  if (behind_leap > 0 && known.points.size() < 2) known.points.clear();
  // On a busy machine a larger budget may take less time.
  std::ranges::stable_sort(known.points, {}, [](const ConvergencePoint* point) { return point->seconds.value; });
  return known;
}

std::optional<LineFit> fit_in_logarithms(const KnownPoints& curve) {
  std::vector<double> log_seconds, log_relmse;
  for (const ConvergencePoint* point : curve.points) {
    log_seconds.push_back(std::log(point->seconds.value));
    log_relmse.push_back(std::log(point->relmse->value));
  }
  return fit_line(log_seconds, log_relmse);
}

TargetTime time_to_target(const KnownPoints& curve, double relmse) {
  TargetTime target{relmse};
  if (curve.points.empty()) {
    target.undefined = curve.leap.empty() ? no_own_error : curve.leap;
    return target;
  }
  if (const std::optional<Place> place = place_of_error(curve.points, relmse)) {
    const double seconds = interpolated(place->from->seconds.value, place->to->seconds.value, place->share);
    const double slope = slope_of(curve);
    target.seconds = Estimate{seconds, slope < 0 ? interval_at(*place, seconds, 1 / slope, 1) : std::nullopt};
  } else if (curve.points.front()->relmse->value <= relmse) {
    target.at_most = curve.points.front()->seconds.value;
  } else {
    target.more_than = curve.points.back()->seconds.value;
  }
  return target;
}

std::optional<Estimate> error_at_time(const KnownPoints& curve, double seconds) {
  const std::optional<Place> place = place_of_time(curve.points, seconds);
  if (!place) return std::nullopt;
  const double error = interpolated(place->from->relmse->value, place->to->relmse->value, place->share);
  return Estimate{error, interval_at(*place, error, 1, slope_of(curve))};
}

}  // namespace photonproof::inline harness_conclusions
