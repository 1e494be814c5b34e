#include "harness/stress/soak/drift.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "harness/statistics/student.h"
#include "harness/stress/soak/soak_fields.h"

namespace photonproof::inline harness_stress_soak {
namespace {

constexpr double tail = 0.001;

/// Lag-one correlation of residuals; 0 where they do not follow each other, or alternate.
double lag_one_correlation(std::span<const double> residuals, double squares) {
  double products = 0;
  for (std::size_t i = 1; i < residuals.size(); ++i) products += residuals[i - 1] * residuals[i];
  constexpr double most = 0.95;  // above this a dozen values cannot show the correlation, either
  return squares > 0 ? std::clamp(products / squares, 0.0, most) : 0;
}

DriftVerdict verdict_of(const Drift& drift, double bound) {
  if (drift.interval.high <= bound) return DriftVerdict::flat;
  return drift.interval.low > 0 ? DriftVerdict::grows : DriftVerdict::unclear;
}

}  // namespace

std::string to_string(DriftVerdict verdict) { return word_of(verdict); }

Drift drift_of(std::span<const double> values, double bound) {
  Drift drift;
  const auto n = static_cast<double>(values.size());
  if (!values.empty()) drift.mean_value = std::accumulate(values.begin(), values.end(), 0.0) / n;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  drift.interval = {-infinity, infinity};
  if (values.size() < least_drift_values) return drift;
  const double middle = (n - 1) / 2, spread = n * (n * n - 1) / 12;  // sum of (i - middle)^2
  for (std::size_t i = 0; i < values.size(); ++i)
    drift.slope += (static_cast<double>(i) - middle) * (values[i] - drift.mean_value) / spread;
  std::vector<double> residuals;
  double squares = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    residuals.push_back(values[i] - drift.mean_value - drift.slope * (static_cast<double>(i) - middle));
    squares += residuals.back() * residuals.back();
  }
  const double r = lag_one_correlation(residuals, squares);
  const double worth = std::max(n * (1 - r) / (1 + r), 3.0);
  const double error = std::sqrt(squares / (worth - 2) / spread);
  const double reach = t_quantile(tail, worth - 2) * error;
  drift.interval = {drift.slope - reach, drift.slope + reach};
  drift.verdict = verdict_of(drift, bound);
  return drift;
}

}  // namespace photonproof::inline harness_stress_soak
