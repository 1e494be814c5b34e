// Student's t: the significance of a deviation whose standard error is itself an estimate.
#pragma once

#include <span>

namespace photonproof::inline harness_statistics {

/// The normal deviate with the tail probability of Student's t beyond |t|, for `freedom` degrees of freedom. An
/// infinite freedom is allowed here and below.
double normal_deviate(double t, double freedom);

/// The normal deviate with the probability that a Gamma variable of this shape is more than t deviations above its
/// mean. It uses Wilson and Hilferty (1931), or the tail itself below a shape of 1, where their formula is far off. The
/// skewness is 2/sqrt(shape).
double gamma_deviate(double t, double shape);

/// The t that Student's t exceeds with probability `tail`, 0 < tail <= 0.5.
double t_quantile(double tail, double freedom);

/// The degrees of freedom f0 of an expectation of variances. `ratios`: variances over their expectations, each
/// estimated with `freedom` degrees (Smyth 2004, "Linear models and empirical Bayes methods for assessing differential
/// expression", section 6.2). Infinite where the ratios vary only as estimates of one truth do; near 0 where the
/// expectation is worthless. Ratios of 0 are left out. An estimate s^2 and its expectation e then give the steadier (f0
/// e + freedom s^2)/(f0 + freedom), with f0 + freedom degrees.
double freedom_of_expectation(std::span<const double> ratios, double freedom);

}  // namespace photonproof::inline harness_statistics
