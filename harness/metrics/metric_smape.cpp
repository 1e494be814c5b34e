// Symmetric mean absolute percentage error as JERI defines it: mean of 2 |x-r| / (|x| + |r| + 0.02), from 0 to 2.

#include <cmath>

#include "harness/metrics/metric_mean_error.h"

namespace photonproof::inline harness_metrics {
namespace {

struct SmapeError {
  double operator()(double x, double r) const { return 2 * std::abs(x - r) / (std::abs(x) + std::abs(r) + 0.02); }
};

}  // namespace

std::unique_ptr<MetricPass> smape_pass(const PairFacts& pair) {
  return std::make_unique<MeanErrorPass<SmapeError>>(pair);
}
std::string smape_parameters() { return "epsilon=0.02"; }

}  // namespace photonproof::inline harness_metrics
