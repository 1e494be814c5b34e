#include "harness/statistics/deviation.h"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>

#include "harness/statistics/student.h"

namespace photonproof {

double Deviation::errors() const {
  if (difference == 0) return 0;
  const double t = difference / standard_error;
  return t > 0 && skewness > 0 ? gamma_deviate(t, 4 / (skewness * skewness)) : t;
}

double Deviation::deviate() const { return std::copysign(normal_deviate(errors(), freedom), difference); }

double Deviation::margin(double tail) const { return t_quantile(tail, freedom) * standard_error; }

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

double chi_square_bound(std::size_t degrees, double alpha) {
  return boost::math::quantile(boost::math::complement(boost::math::chi_squared(static_cast<double>(degrees)), alpha));
}

double chi_square(std::span<const Deviation> blocks) {
  double sum = 0;
  for (const Deviation& block : blocks) sum += std::pow(block.deviate(), 2);
  return sum;
}

BlockChiSquare chi_square_of_blocks(const std::array<std::vector<Deviation>, 3>& blocks, double alpha) {
  BlockChiSquare worst;
  worst.bound = chi_square_bound(blocks[0].size(), sidak(alpha, 3));
  for (std::size_t c = 0; c < 3; ++c) {
    const double value = chi_square(blocks[c]);
    if (value <= worst.value) continue;
    worst.value = value;
    worst.channel = c;
  }
  return worst;
}

}  // namespace photonproof
