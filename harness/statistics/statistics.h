// Small-sample statistics of benchmarks: medians, bootstrap intervals, least squares, outliers. Everything is
// deterministic: resampling draws from a generator of a fixed seed.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "reports/record/results.h"

namespace photonproof {

/// Precondition of all of these: no value is NaN, and there is at least one.
double mean_of(std::span<const double> values);
double median_of(std::span<const double> values);  ///< of an even number, the mean of the two in the middle

struct BootstrapOptions {
  double confidence = 0.95;
  int resamples = 2000;
  std::uint64_t seed = 1;
};

/// A statistic of the observations whose indices it is given, of which some may repeat.
using IndexStatistic = std::function<double(std::span<const std::size_t> indices)>;

/// Percentile interval (Efron 1979) of a statistic of `count` independent observations. It commutes with monotone
/// transformations and suits medians; of five observations, the median's is from the least to the largest.
Interval bootstrap_percentile(std::size_t count, const IndexStatistic& statistic, const BootstrapOptions& options = {});

/// Bias-corrected and accelerated (Efron 1987, "Better bootstrap confidence intervals"): for smooth statistics such as
/// means, whose skewed distribution it follows.
Interval bootstrap_bca(std::size_t count, const IndexStatistic& statistic, const BootstrapOptions& options = {});

/// The mean and its BCa interval; no interval below two values.
Estimate estimated_mean(std::span<const double> values, const BootstrapOptions& options = {});
/// The median and its percentile interval; no interval below five values, which is where one of 95 % is to be had.
Estimate estimated_median(std::span<const double> values, const BootstrapOptions& options = {});

struct LineFit {
  double slope = 0, intercept = 0;
  std::optional<Interval> slope_interval;  ///< Student's t at 95 %; needs three points
};
/// Least squares of y on x. Empty with fewer than two different x.
std::optional<LineFit> fit_line(std::span<const double> x, std::span<const double> y);

/// Indices of the values whose modified z-score 0.6745 |x - median| / MAD exceeds 3.5 (Iglewicz and Hoaglin 1993);
/// none where fewer than five values or a MAD of 0 give no scale to judge by.
std::vector<std::size_t> outliers_of(std::span<const double> values);

}  // namespace photonproof
