// Mean relative squared error as pbrt's imgtool prints it: mean of (x-r)^2/(r+0.01)^2. A negative value of exactly
// -0.01 in the reference makes it undefined.

#include <cmath>

#include "harness/metrics/metric_mean_error.h"

namespace photonproof::inline harness_metrics {
namespace {

struct MrseError {
  double operator()(double x, double r) const { return (x - r) * (x - r) / ((r + 0.01) * (r + 0.01)); }
};

class MrsePass : public MeanErrorPass<MrseError> {
 public:
  using MeanErrorPass<MrseError>::MeanErrorPass;
  std::optional<double> value(std::size_t which) const override {
    const auto mean = MeanErrorPass<MrseError>::value(which);
    return std::isfinite(*mean) ? mean : std::nullopt;
  }
};

}  // namespace

std::unique_ptr<MetricPass> mrse_pbrt_pass(const PairFacts& pair) { return std::make_unique<MrsePass>(pair); }
std::string mrse_pbrt_parameters() { return "epsilon=0.01"; }

}  // namespace photonproof::inline harness_metrics
