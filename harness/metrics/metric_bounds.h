// Bounds on metrics, "ssim=0.95", and whether measured values keep them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "harness/metrics/metric_rows.h"

namespace photonproof::inline harness_metrics {

struct MetricBound {
  const MetricRow* metric;
  double bound;
};

/// The row of that name. Throws InputError, at `option` ("--fail"), when there is none; then it names the nearest one.
const MetricRow& metric_named(const std::string& option, const std::string& name);

/// Reads "metric=bound"; `option` ("--fail") stands for the place in messages. Throws InputError when the form is
/// another, the bound is no finite number, or the metric is unknown; then it names the nearest one.
MetricBound parse_bound(const std::string& option, const std::string& text);

/// Why the bound is not kept, as a sentence; empty when it is. A minimum for psnr and ssim, a maximum for the rest, for
/// bias on its absolute value. A metric without a value does not keep any bound.
std::optional<std::string> broken_bound(const MetricBound& bound, const std::vector<Measurement>& measurements);

}  // namespace photonproof::inline harness_metrics
