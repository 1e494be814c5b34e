#include "reports/view/metric_columns.h"

#include "reports/view/numbers.h"

namespace photonproof::reports::inline reports_view {

std::span<const MetricColumn> metric_columns() {
  constexpr auto three_digits = [](double v) { return significant(v, 3); };
  constexpr auto four_decimals = [](double v) { return fixed_decimals(v, 4); };
  constexpr auto two_decimals = [](double v) { return fixed_decimals(v, 2); };
  static const MetricColumn columns[] = {
      {"relmse", "relMSE",
       "squared error relative to the reference's squared value, mean over pixels and channels; 0 is equal",
       three_digits},
      {"relmse_trimmed", "relMSE trimmed",
       "the same without its largest pixels, so that a few fireflies do not hide the rest", three_digits},
      {"ssim", "SSIM", "structural similarity of the displayed pictures; 1 is equal", four_decimals},
      {"psnr", "PSNR dB", "peak signal-to-noise ratio of the displayed pictures; higher is closer", two_decimals},
      {"flip", "FLIP", "mean perceived difference when flipping between the displayed pictures, 0 to 1; 0 is equal",
       four_decimals},
      {"bias", "bias %", "mean of test minus reference, relative to the mean of the reference, signed", signed_percent},
  };
  return columns;
}

std::string format_metric(const std::string& metric, double value) {
  for (const MetricColumn& column : metric_columns()) {
    if (metric == column.metric) return column.format(value);
  }
  return significant(value, 3);
}

}  // namespace photonproof::reports::inline reports_view
