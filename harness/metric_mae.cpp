// Mean and greatest absolute error on linear values: mae = sum |x-r| / N, N = pixels x 3. (idiff's "Mean error" and
// "Max error" of linear images.)

#include <algorithm>
#include <cmath>

#include "harness/metric_rows.h"
#include "harness/metric_sum.h"

namespace photonproof {
namespace {

double absolute_error(const MetricContext& context, std::size_t i) {
  return std::abs(static_cast<double>(context.test().rgb[i]) - static_cast<double>(context.reference().rgb[i]));
}

}  // namespace

std::optional<double> mae(const MetricContext& context) {
  return chunked_mean(context.reference().rgb.size(), [&](std::size_t i) { return absolute_error(context, i); });
}

std::optional<double> max_abs(const MetricContext& context) {
  double greatest = 0;
  for (std::size_t i = 0; i < context.reference().rgb.size(); ++i)
    greatest = std::max(greatest, absolute_error(context, i));
  return greatest;
}

}  // namespace photonproof
