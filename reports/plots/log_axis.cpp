#include "reports/plots/log_axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace photonproof::reports::inline reports_plots {

LogAxis log_axis(double smallest, double largest) {
  constexpr double margin = 0.06;  // of the axis, on either side of the data
  double low = std::log10(smallest), high = std::log10(largest);
  const double widen = std::max(0.0, std::log10(4.0) - (high - low)) / 2;
  low -= widen + margin * (high - low);
  high += widen + margin * (high - low);
  LogAxis axis{std::pow(10.0, low), std::pow(10.0, high), {}};
  const double decades = high - low;
  std::vector<int> mantissas{1};
  if (decades < 1.3) {
    mantissas = {1, 2, 3, 5, 7};
  } else if (decades < 3) {
    mantissas = {1, 2, 5};
  }
  const int step = std::max(1, static_cast<int>(std::ceil(decades / 9)));
  for (int exponent = static_cast<int>(std::floor(low)); exponent <= static_cast<int>(std::ceil(high)); ++exponent) {
    if (exponent % step != 0) continue;
    for (const int mantissa : mantissas) {
      const double tick = mantissa * std::pow(10.0, exponent);
      if (tick >= axis.low && tick <= axis.high) axis.ticks.push_back(tick);
    }
  }
  return axis;
}

double LogScale::operator()(double value) const {
  const double t = std::log(value / axis.low) / std::log(axis.high / axis.low);
  return from + std::clamp(t, 0.0, 1.0) * (to - from);
}

void ValueRange::hold(double value) {
  low = std::min(low, value);
  high = std::max(high, value);
}

void ValueRange::hold(const std::optional<Interval>& interval) {
  if (!interval) return;
  hold(interval->low);
  hold(interval->high);
}

std::string svg_line(double x1, double y1, double x2, double y2) {
  return fmt::format("<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\"/>", x1, y1, x2, y2);
}

}  // namespace photonproof::reports::inline reports_plots
