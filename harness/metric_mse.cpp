// Mean squared error and its root, on linear values: mse = sum (x-r)^2 / N, N = pixels x 3.

#include <cmath>

#include "harness/metric_rows.h"
#include "harness/metric_sum.h"

namespace photonproof {

std::optional<double> mse(const MetricContext& context) {
  const auto& r = context.reference().rgb;
  const auto& x = context.test().rgb;
  return chunked_mean(r.size(), [&](std::size_t i) {
    const double difference = static_cast<double>(x[i]) - static_cast<double>(r[i]);
    return difference * difference;
  });
}

std::optional<double> rmse(const MetricContext& context) { return std::sqrt(*mse(context)); }

}  // namespace photonproof
