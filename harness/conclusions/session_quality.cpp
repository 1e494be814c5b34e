#include "harness/conclusions/session_quality.h"

#include <fmt/format.h>
#include <stdlib.h>

#include <cmath>

#include "harness/conclusions/paired_rounds.h"
#include "harness/statistics/statistics.h"

namespace photonproof::inline harness_conclusions {

std::string load_caveat(int cores) {
  double load = 0;
  return getloadavg(&load, 1) == 1 ? load_caveat(load, cores) : "";
}

std::string load_caveat(double load, int cores) {
  if (load <= cores) return {};
  return fmt::format("load average {:.1f} on {} cores when it began: wall times are longer than the engines need", load,
                     cores);
}

std::string control_caveat(const Results& results, const std::string& control, const std::string& twin) {
  std::vector<double> ratios;
  for (const Result& again : results.results) {
    if (again.cell.engine != twin || again.status != Status::ok) continue;
    Cell first = again.cell;
    first.engine = control;
    const Result* other = results.find(first.label());
    if (other == nullptr || other->status != Status::ok) continue;
    const double was = other->wall_seconds.value_or(0), is = again.wall_seconds.value_or(0);
    if (was > 0 && is > 0) ratios.push_back(std::log(is / was));
  }
  if (ratios.empty()) return {};
  const Estimate logarithm = estimated_median(ratios);
  if (!logarithm.interval)
    return fmt::format("control: {} pairs of '{}' with itself are too few for an interval", ratios.size(), control);
  const Estimate ratio{std::exp(logarithm.value),
                       Interval{std::exp(logarithm.interval->low), std::exp(logarithm.interval->high)}};
  if (ratio.interval->low <= 1 && 1 <= ratio.interval->high) return {};
  return "this session is noisy, its times decide nothing: '" + control + "' against itself takes " +
         ratio_text(ratio) + " times as long";
}

}  // namespace photonproof::inline harness_conclusions
