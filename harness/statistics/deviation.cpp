#include "harness/statistics/deviation.h"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>

#include "harness/statistics/student.h"

namespace photonproof::inline harness_statistics {

double Deviation::errors() const {
  if (difference == 0) return 0;
  const bool may_miss = difference < 0 || two_sided, may_be_skewed = difference > 0 || two_sided;
  const double missing = may_miss ? sample * std::abs(difference) / 2 : 0;
  const double t = std::abs(difference) / std::sqrt(standard_error * standard_error + missing);
  const bool skewed = may_be_skewed && skewness > 0;
  return std::copysign(skewed ? gamma_deviate(t, 4 / (skewness * skewness)) : t, difference);
}

double Deviation::deviate() const { return std::copysign(normal_deviate(errors(), freedom), difference); }

double Deviation::margin(double tail) const {
  // |errors()| = q below the reference: D^2 = q^2 (s^2 + f D/2).
  const double q = t_quantile(tail, freedom), by_samples = q * q * sample / 4;
  return by_samples + std::hypot(by_samples, q * standard_error);
}

Deviation deviation_of(double mean, double reference, const KnownVariance& of_mean, const KnownVariance& of_reference) {
  const double least = rounding_deviation * std::max(std::abs(mean), std::abs(reference));
  const double variance = of_mean.variance + of_reference.variance + least * least;
  const double doubt = std::pow(of_mean.variance / variance, 2) / of_mean.freedom +
                       std::pow(of_reference.variance / variance, 2) / of_reference.freedom;
  Deviation deviation{mean - reference, std::sqrt(variance)};
  deviation.expected = reference;
  if (variance > 0 && doubt > 0) deviation.freedom = 1 / doubt;
  return deviation;
}

double chi_square_bound(double degrees, double alpha) {
  return boost::math::quantile(boost::math::complement(boost::math::chi_squared(degrees), alpha));
}

double chi_square(std::span<const Deviation> blocks) {
  double sum = 0;
  for (const Deviation& block : blocks) sum += std::pow(block.deviate(), 2);
  return sum;
}

BlockChiSquare chi_square_of_blocks(const std::array<std::vector<Deviation>, 3>& blocks,
                                    const std::array<double, 3>& independent, double alpha) {
  BlockChiSquare worst;
  const auto count = static_cast<double>(blocks[0].size());
  for (std::size_t c = 0; c < 3; ++c) {
    const double value = chi_square(blocks[c]);
    const double bound = count / independent[c] * chi_square_bound(independent[c], sidak(alpha, 3));
    if (worst.bound > 0 && value / bound <= worst.value / worst.bound) continue;
    worst = {c, value, bound};
  }
  return worst;
}

BlockChiSquare chi_square_of_blocks(const std::array<std::vector<Deviation>, 3>& blocks, double alpha) {
  const auto count = static_cast<double>(blocks[0].size());
  return chi_square_of_blocks(blocks, {count, count, count}, alpha);
}

}  // namespace photonproof::inline harness_statistics
