// Student's t: what a deviation means whose standard error is itself an estimate.
#pragma once

#include <span>

namespace photonproof::inline harness_statistics {

/// The normal deviate of the probability that Student's t with `freedom` degrees of freedom has beyond |t|. An infinite
/// freedom is allowed here and below.
double normal_deviate(double t, double freedom);

/// The normal deviate of the probability that a Gamma variable of this shape has more than t deviations above its mean
/// (Wilson and Hilferty 1931; below a shape of 1, where that is far off, the tail itself). Its skewness is
/// 2/sqrt(shape).
double gamma_deviate(double t, double shape);

/// The t that is exceeded with probability `tail`, 0 < tail <= 0.5.
double t_quantile(double tail, double freedom);

/// Of many variances, each estimated with `freedom` degrees of freedom, as ratios to what was expected of them: how
/// many degrees of freedom the expectation is worth itself (Smyth 2004, "Linear models and empirical Bayes methods for
/// assessing differential expression", section 6.2). Infinite where the ratios vary no more than such estimates do
/// around one truth; near 0 where the expectation says nothing. Ratios of 0 are left out. An estimate s^2 and its
/// expectation e then make the steadier (f0 e + freedom s^2)/(f0 + freedom), with f0 + freedom degrees.
double freedom_of_expectation(std::span<const double> ratios, double freedom);

}  // namespace photonproof::inline harness_statistics
