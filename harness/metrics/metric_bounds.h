// Bounds on metrics, "ssim=0.95", and the test whether measured values keep them.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "harness/metrics/metric_rows.h"

namespace photonproof::inline harness_metrics {

struct MetricBound {
  const MetricRow* metric;
  double bound;
};

/// The row of that name. Throws InputError at `option` ("--fail") for an unknown name, with the nearest one.
const MetricRow& metric_named(const std::string& option, const std::string& name);

/// The number of "0.1 %" or "0.1%"; empty for any other text.
std::optional<double> share_from_text(std::string_view text);

/// Reads "metric=bound", or "differing=0.1%"; `option` ("--fail") is the place in messages. Throws InputError for
/// another form, a bound that is no finite number, or an unknown metric, with the nearest one.
MetricBound parse_bound(const std::string& option, const std::string& text);

/// The reason why the bound is not kept, as a sentence; empty when it is kept. The bound is a minimum for psnr and
/// ssim, else a maximum, for bias on its absolute value. A metric without a value does not keep any bound.
std::optional<std::string> broken_bound(const MetricBound& bound, const std::vector<Measurement>& measurements);

}  // namespace photonproof::inline harness_metrics
