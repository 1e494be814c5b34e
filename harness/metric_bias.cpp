// Relative bias, signed: mean(x-r)/mean(r), over all channels or over one. Energy lost or gained, whatever the noise.

#include "harness/metric_rows.h"
#include "harness/metric_sum.h"

namespace photonproof {
namespace {

/// Over the values first, first + step, ...
std::optional<double> relative_bias(const MetricContext& context, std::size_t first, std::size_t step) {
  const auto& r = context.reference().rgb;
  const auto& x = context.test().rgb;
  const std::size_t count = r.size() / step;
  const double reference_sum =
      chunked_sum(count, [&](std::size_t i) { return static_cast<double>(r[first + step * i]); });
  if (reference_sum == 0) return std::nullopt;
  const double difference_sum = chunked_sum(count, [&](std::size_t i) {
    return static_cast<double>(x[first + step * i]) - static_cast<double>(r[first + step * i]);
  });
  return difference_sum / reference_sum;
}

}  // namespace

std::optional<double> bias(const MetricContext& context) { return relative_bias(context, 0, 1); }
std::optional<double> bias_r(const MetricContext& context) { return relative_bias(context, 0, 3); }
std::optional<double> bias_g(const MetricContext& context) { return relative_bias(context, 1, 3); }
std::optional<double> bias_b(const MetricContext& context) { return relative_bias(context, 2, 3); }

}  // namespace photonproof
