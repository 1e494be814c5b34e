#include "harness/statistics/student.h"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <boost/math/special_functions/trigamma.hpp>
#include <cmath>
#include <limits>
#include <vector>

namespace photonproof::inline harness_statistics {
namespace {

namespace bm = boost::math;

// Double precision is enough, to 1e-13 of a tail. Boost's own choice, long double, takes several times as long.
using InDouble = bm::policies::policy<bm::policies::promote_double<false>>;
using StudentsT = bm::students_t_distribution<double, InDouble>;
using Normal = bm::normal_distribution<double, InDouble>;

constexpr double as_good_as_infinite = 1e6;  // degrees of freedom

/// Newton's method on 1/trigamma, which is nearly linear (Smyth 2004, appendix).
double inverse_trigamma(double y) {
  double x = 0.5 + 1 / y;
  for (int i = 0; i < 50; ++i) {
    const double value = bm::trigamma(x);
    // trigamma' by a central difference: it only steers the iteration.
    const double h = 1e-5 * x;
    const double slope = (bm::trigamma(x + h) - bm::trigamma(x - h)) / (2 * h);
    const double step = value * (1 - value / y) / slope;
    x += step;
    if (std::abs(step) < 1e-8 * x) break;
  }
  return x;
}

}  // namespace

double normal_deviate(double t, double freedom) {
  if (freedom > as_good_as_infinite) return std::abs(t);
  const double tail = bm::cdf(StudentsT(freedom), -std::abs(t));
  return -bm::quantile(Normal(), std::clamp(tail, 1e-300, 0.5));
}

double gamma_deviate(double t, double shape) {
  if (!(shape < as_good_as_infinite)) return t;
  if (shape < 1) {
    const double tail = bm::gamma_q(shape, std::max(0.0, shape + t * std::sqrt(shape)), InDouble());
    return -bm::quantile(Normal(), std::clamp(tail, 1e-300, 1 - 1e-16));
  }
  return 3 * std::sqrt(shape) * (std::cbrt(1 + t / std::sqrt(shape)) - 1 + 1 / (9 * shape));
}

double t_quantile(double tail, double freedom) {
  if (freedom > as_good_as_infinite) return -bm::quantile(Normal(), tail);
  return -bm::quantile(StudentsT(freedom), tail);
}

double freedom_of_expectation(std::span<const double> ratios, double freedom) {
  std::vector<double> logs;
  for (const double ratio : ratios)
    if (ratio > 0) logs.push_back(std::log(ratio));
  if (logs.size() < 2) return 0;
  double mean = 0, spread = 0;
  for (const double value : logs) mean += value;
  mean /= static_cast<double>(logs.size());
  for (const double value : logs) spread += (value - mean) * (value - mean);
  spread /= static_cast<double>(logs.size() - 1);
  const double excess = spread - bm::trigamma(freedom / 2);
  if (excess <= 1e-6) return std::numeric_limits<double>::infinity();
  return 2 * inverse_trigamma(excess);
}

}  // namespace photonproof::inline harness_statistics
