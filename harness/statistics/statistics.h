// Small-sample statistics of benchmarks: medians, means, their intervals, least squares, outliers. Everything is
// deterministic: resampling draws from a generator of a fixed seed.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "reports/record/results.h"

namespace photonproof::inline harness_statistics {

/// Precondition of all of these: no value is NaN, and there is at least one.
double mean_of(std::span<const double> values);
double sample_variance(std::span<const double> values);  ///< for two values or more
/// Half-width of a two-sided 95 % interval in standard errors, by Student's t.
double student_975(double freedom);
double median_of(std::span<const double> values);  ///< for an even number, the mean of the two in the middle

struct BootstrapOptions {
  double confidence = 0.95;
  int resamples = 2000;
  std::uint64_t seed = 1;
};

/// A statistic of the observations with the given indices, which may repeat.
using IndexStatistic = std::function<double(std::span<const std::size_t> indices)>;

/// Bias-corrected and accelerated interval (Efron 1987, "Better bootstrap confidence intervals"), for smooth statistics
/// such as means; it follows their skewed distribution. It needs dozens of observations. For the mean of two values it
/// reaches from one to the other, which holds the truth half of the time.
Interval bootstrap_bca(std::size_t count, const IndexStatistic& statistic, const BootstrapOptions& options = {});

/// 95 % interval of a smooth statistic of a few independent observations: Student's, with the standard error of the
/// jackknife (Tukey 1958). For a mean it is the textbook's. Precondition: two observations or more.
Interval jackknife_interval(std::size_t count, const IndexStatistic& statistic);

/// `value` times and by exp(relative_half_width): an interval on the logarithm, whose ends stay positive.
Interval interval_on_logarithm(double value, double relative_half_width);

/// The mean of positive values and Student's 95 % interval, taken on the logarithm; no interval below two values.
Estimate estimated_mean(std::span<const double> values);
/// The median and its 95 % interval between order statistics, interpolated (Hettmansperger and Sheather 1986,
/// "Confidence intervals based on interpolated order statistics"). It covers 94 to 95 % whatever the distribution is;
/// the percentile bootstrap covers 87 % of seven values. No interval below six values: from the least to the largest of
/// five lies the median with probability 1 - 2/32.
Estimate estimated_median(std::span<const double> values);
/// The median of positive times. Below six of them the interval is Student's of their logarithms; no interval below
/// two. It covers 95 % of log-normal times and 93 % of those with an exponential tail.
Estimate estimated_time(std::span<const double> values);

struct LineFit {
  double slope = 0, intercept = 0;
  std::optional<Interval> slope_interval;  ///< Student's t at 95 %; needs three points
};
/// Least squares of y on x. Empty with fewer than two different x.
std::optional<LineFit> fit_line(std::span<const double> x, std::span<const double> y);

/// Indices of the values whose modified z-score 0.6745 |x - median| / MAD exceeds 3.5 (Iglewicz and Hoaglin 1993).
/// Empty where fewer than five values or a MAD of 0 give no scale.
std::vector<std::size_t> outliers_of(std::span<const double> values);

}  // namespace photonproof::inline harness_statistics
