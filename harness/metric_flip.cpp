// Pools the FLIP map into the numbers NVIDIA's tool prints: mean, weighted median and quartiles, maximum (Andersson,
// Nilsson, Akenine-Möller: "Visualizing and communicating errors in rendered images", Ray Tracing Gems II, 2021).

#include "harness/metric_flip.h"

#include "harness/metric_rows.h"
#include "harness/metric_sum.h"
#include "scenes/text_numbers.h"

namespace photonproof {
namespace {

/// Each error weighs as much as it is large: the smallest error at which the running sum of the ascending errors passes
/// `fraction` of their sum. 0 when all errors are.
double weighted_percentile(const std::vector<float>& ascending, double fraction) {
  const auto value = [&](std::size_t i) { return static_cast<double>(ascending[i]); };
  const double passed = fraction * chunked_sum(ascending.size(), value);
  double running = 0;
  for (std::size_t i = 0; i < ascending.size(); ++i) {
    running += value(i);
    if (running > passed) return value(i);
  }
  return 0;
}

}  // namespace

std::optional<double> flip(const MetricContext& context) {
  const auto& errors = context.flip_map();
  return chunked_mean(errors.size(), [&](std::size_t i) { return static_cast<double>(errors[i]); });
}

std::optional<double> flip_weighted_quartile1(const MetricContext& context) {
  return weighted_percentile(context.flip_sorted(), 0.25);
}

std::optional<double> flip_weighted_median(const MetricContext& context) {
  return weighted_percentile(context.flip_sorted(), 0.5);
}

std::optional<double> flip_weighted_quartile3(const MetricContext& context) {
  return weighted_percentile(context.flip_sorted(), 0.75);
}

std::optional<double> flip_max(const MetricContext& context) {
  return static_cast<double>(context.flip_sorted().back());
}

std::string flip_parameters(const MetricOptions& options) {
  return "exposure=" + format_number(options.exposure) + ", pixels_per_degree=67.0206";
}

}  // namespace photonproof
