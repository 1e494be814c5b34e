#include "harness/metrics/metric_bounds.h"

#include <algorithm>
#include <cmath>

#include "scenes/base/edit_distance.h"
#include "scenes/base/input_error.h"
#include "scenes/base/text_numbers.h"

namespace photonproof::inline harness_metrics {
namespace {

std::string unknown_metric(const std::string& name) {
  const auto distance = [&](const MetricRow& row) { return edit_distance(name, row.name); };
  return "unknown metric " + in_quotes(name) + "; the nearest is '" +
         std::ranges::min(metric_rows(), {}, distance).name + "', and compare --help lists all";
}

bool keeps(BoundKind kind, double value, double bound) {
  switch (kind) {
    case BoundKind::maximum:
      return value <= bound;
    case BoundKind::minimum:
      return value >= bound;
    case BoundKind::absolute_maximum:
      return std::abs(value) <= bound;
  }
  return false;
}

}  // namespace

const MetricRow& metric_named(const std::string& option, const std::string& name) {
  const MetricRow* metric = find_metric(name);
  if (!metric) throw InputError(option, unknown_metric(name));
  return *metric;
}

std::optional<double> share_from_text(std::string_view text) {
  if (!text.ends_with('%')) return std::nullopt;
  text.remove_suffix(1);
  if (text.ends_with(' ')) text.remove_suffix(1);
  const Parsed<double> percent = parse_number(text);
  return percent.value ? std::optional(*percent.value / 100) : std::nullopt;
}

MetricBound parse_bound(const std::string& option, const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos)
    throw InputError(option, "expected metric=bound, for example ssim=0.95, got " + in_quotes(text));
  const std::string name = text.substr(0, equals);
  const MetricRow& metric = metric_named(option, name);
  const std::string_view limit = std::string_view(text).substr(equals + 1);
  if (name == "differing")
    if (const auto share = share_from_text(limit)) return {&metric, *share};
  const Parsed<double> bound = parse_number(limit);
  if (!bound.value) throw InputError(option, "the bound of " + name + " " + bound.problem);
  return {&metric, *bound.value};
}

std::optional<std::string> broken_bound(const MetricBound& bound, const std::vector<Measurement>& measurements) {
  const MetricRow& metric = *bound.metric;
  const auto measured = std::ranges::find(measurements, &metric, &Measurement::row);
  if (measured == measurements.end() || !measured->value)
    return std::string(metric.name) + " has no value here (" + metric.undefined_when + "), so its bound is not kept";
  const double value = *measured->value;
  if (keeps(metric.bound, value, bound.bound)) return std::nullopt;
  const char* relation = metric.bound == BoundKind::minimum   ? " is under its minimum "
                         : metric.bound == BoundKind::maximum ? " is over its maximum "
                                                              : " is in absolute value over its maximum ";
  return metric.name + (" " + format_number(value)) + relation + format_number(bound.bound);
}

}  // namespace photonproof::inline harness_metrics
