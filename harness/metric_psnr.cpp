// Peak signal-to-noise ratio in decibels: 10 log10(1/mse) on display-encoded values, whose peak is 1.

#include <cmath>

#include "harness/metric_rows.h"
#include "harness/metric_sum.h"
#include "scenes/text_numbers.h"

namespace photonproof {

std::optional<double> psnr(const MetricContext& context) {
  const auto& [r, x] = context.encoded();
  const double error =
      chunked_mean(r.size(), [&r = r, &x = x](std::size_t i) { return (x[i] - r[i]) * (x[i] - r[i]); });
  return 10 * std::log10(1 / error);
}

std::string psnr_parameters(const MetricOptions& options) {
  return "exposure=" + format_number(options.exposure) + ", peak=1";
}

}  // namespace photonproof
