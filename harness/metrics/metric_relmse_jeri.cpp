// relmse as JERI defines it: mean of (x-r)^2/(r^2+epsilon), epsilon = 1e-4. Dark pixels weigh more than in relmse.

#include "harness/metrics/metric_mean_error.h"

namespace photonproof::inline harness_metrics {
namespace {

struct RelmseError {
  double operator()(double x, double r) const { return (x - r) * (x - r) / (r * r + 1e-4); }
};

}  // namespace

std::unique_ptr<MetricPass> relmse_jeri_pass(const PairFacts& pair) {
  return std::make_unique<MeanErrorPass<RelmseError>>(pair);
}
std::string relmse_jeri_parameters() { return "epsilon=0.0001"; }

}  // namespace photonproof::inline harness_metrics
