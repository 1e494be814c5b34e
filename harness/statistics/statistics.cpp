#include "harness/statistics/statistics.h"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <numeric>
#include <random>

namespace photonproof::inline harness_statistics {
namespace {

constexpr double two_sided_975 = 0.975;
constexpr std::size_t least_for_outliers = 5;
constexpr double normal_quartile = 0.6745;  // a normal distribution's MAD in standard deviations
constexpr double outlier_score = 3.5;

// Standard distributions differ between libraries; this one does not.
std::size_t draw_below(std::size_t count, std::mt19937_64& generator) {
  return static_cast<std::size_t>((static_cast<unsigned __int128>(generator()) * count) >> 64);
}

std::vector<double> sorted_resamples(std::size_t count, const IndexStatistic& statistic,
                                     const BootstrapOptions& options) {
  std::mt19937_64 generator(options.seed);
  std::vector<std::size_t> indices(count);
  std::vector<double> statistics;
  statistics.reserve(static_cast<std::size_t>(options.resamples));
  for (int i = 0; i < options.resamples; ++i) {
    for (std::size_t& index : indices) index = draw_below(count, generator);
    statistics.push_back(statistic(indices));
  }
  std::sort(statistics.begin(), statistics.end());
  return statistics;
}

double quantile(const std::vector<double>& sorted, double q) {
  const double at = q * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  if (below + 1 >= sorted.size()) return sorted.back();
  return std::lerp(sorted[below], sorted[below + 1], at - static_cast<double>(below));
}

std::vector<std::size_t> all_indices(std::size_t count) {
  std::vector<std::size_t> indices(count);
  std::iota(indices.begin(), indices.end(), std::size_t{0});
  return indices;
}

// The statistic without the first observation, then without the second ...
std::vector<double> jackknife(std::size_t count, const IndexStatistic& statistic) {
  std::vector<double> without_one;
  std::vector<std::size_t> indices = all_indices(count);
  indices.pop_back();
  for (std::size_t left_out = count; left_out-- > 0;) {
    without_one.push_back(statistic(indices));
    if (left_out > 0) indices[left_out - 1] = left_out;
  }
  return without_one;
}

// Sum d^3 / (6 (sum d^2)^1.5) of the deviations of the jackknife's values from their mean.
double acceleration(std::size_t count, const IndexStatistic& statistic) {
  const std::vector<double> without_one = jackknife(count, statistic);
  const double mean = mean_of(without_one);
  double squares = 0, cubes = 0;
  for (const double value : without_one) {
    const double d = mean - value;
    squares += d * d;
    cubes += d * d * d;
  }
  return squares > 0 ? cubes / (6 * std::pow(squares, 1.5)) : 0;
}

}  // namespace

double mean_of(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double sample_variance(std::span<const double> values) {
  const double mean = mean_of(values);
  double squares = 0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return squares / static_cast<double>(values.size() - 1);
}

double student_975(double freedom) { return boost::math::quantile(boost::math::students_t(freedom), two_sided_975); }

double median_of(std::span<const double> values) {
  std::vector<double> sorted(values.begin(), values.end());
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  if (sorted.size() % 2 == 1) return *middle;
  return (*std::max_element(sorted.begin(), middle) + *middle) / 2;
}

Interval bootstrap_bca(std::size_t count, const IndexStatistic& statistic, const BootstrapOptions& options) {
  const std::vector<double> resamples = sorted_resamples(count, statistic, options);
  const double observed = statistic(all_indices(count));
  if (count < 2 || resamples.front() == resamples.back()) return {resamples.front(), resamples.back()};
  const auto [first, last] = std::equal_range(resamples.begin(), resamples.end(), observed);
  const auto n = static_cast<double>(resamples.size());
  // Ties count half; never all or none, whose quantile is infinite.
  const double below = (static_cast<double>(first - resamples.begin()) + 0.5 * static_cast<double>(last - first)) / n;
  const boost::math::normal normal;
  const double z0 = boost::math::quantile(normal, std::clamp(below, 0.5 / n, 1 - 0.5 / n));
  const double a = acceleration(count, statistic);
  const auto end = [&](double q) {
    const double z = z0 + boost::math::quantile(normal, q);
    return quantile(resamples, boost::math::cdf(normal, z0 + z / (1 - a * z)));
  };
  const double tail = (1 - options.confidence) / 2;
  return {end(tail), end(1 - tail)};
}

Interval jackknife_interval(std::size_t count, const IndexStatistic& statistic) {
  const std::vector<double> without_one = jackknife(count, statistic);
  const double mean = mean_of(without_one);
  double squares = 0;
  for (const double value : without_one) squares += (value - mean) * (value - mean);
  const auto n = static_cast<double>(count);
  const double half = student_975(n - 1) * std::sqrt(squares * (n - 1) / n);
  const double observed = statistic(all_indices(count));
  return {observed - half, observed + half};
}

Interval interval_on_logarithm(double value, double relative_half_width) {
  return {value * std::exp(-relative_half_width), value * std::exp(relative_half_width)};
}

Estimate estimated_mean(std::span<const double> values) {
  Estimate estimate{mean_of(values), {}};
  if (values.size() < 2) return estimate;
  const auto n = static_cast<double>(values.size());
  const double standard_error = std::sqrt(sample_variance(values) / n);
  estimate.interval = interval_on_logarithm(estimate.value, student_975(n - 1) * standard_error / estimate.value);
  return estimate;
}

Estimate estimated_median(std::span<const double> values) {
  Estimate estimate{median_of(values), {}};
  const std::size_t n = values.size();
  const boost::math::binomial below(static_cast<double>(n), 0.5);  // how many of n lie below the median
  // Probability that it lies between the k-th least and the k-th largest.
  const auto coverage = [&](std::size_t k) { return 1 - 2 * boost::math::cdf(below, static_cast<double>(k - 1)); };
  constexpr double confidence = 0.95;
  if (coverage(1) < confidence) return estimate;
  std::size_t k = 1;
  while (coverage(k + 1) >= confidence) ++k;
  const double part = (coverage(k) - confidence) / (coverage(k) - coverage(k + 1));
  const auto rank = static_cast<double>(k), left = static_cast<double>(n - k);
  const double inward = left * part / (rank + (left - rank) * part);
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  estimate.interval =
      Interval{std::lerp(sorted[k - 1], sorted[k], inward), std::lerp(sorted[n - k], sorted[n - k - 1], inward)};
  return estimate;
}

Estimate estimated_time(std::span<const double> values) {
  Estimate estimate = estimated_median(values);
  if (estimate.interval || values.size() < 2 || *std::min_element(values.begin(), values.end()) <= 0) return estimate;
  std::vector<double> logarithms;
  for (const double value : values) logarithms.push_back(std::log(value));
  const auto n = static_cast<double>(values.size());
  const double half = student_975(n - 1) * std::sqrt(sample_variance(logarithms) / n);
  estimate.interval = interval_on_logarithm(std::exp(mean_of(logarithms)), half);
  return estimate;
}

std::optional<LineFit> fit_line(std::span<const double> x, std::span<const double> y) {
  if (x.size() < 2) return std::nullopt;
  const auto n = static_cast<double>(x.size());
  const double mean_x = mean_of(x), mean_y = mean_of(y);
  double xx = 0, xy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mean_x) * (x[i] - mean_x);
    xy += (x[i] - mean_x) * (y[i] - mean_y);
  }
  if (xx <= 0) return std::nullopt;
  LineFit fit{xy / xx, mean_y - xy / xx * mean_x, {}};
  if (x.size() < 3) return fit;
  double residuals = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double residual = y[i] - fit.intercept - fit.slope * x[i];
    residuals += residual * residual;
  }
  const double half = student_975(n - 2) * std::sqrt(residuals / (n - 2) / xx);
  fit.slope_interval = Interval{fit.slope - half, fit.slope + half};
  return fit;
}

std::vector<std::size_t> outliers_of(std::span<const double> values) {
  if (values.size() < least_for_outliers) return {};
  const double median = median_of(values);
  std::vector<double> deviations;
  deviations.reserve(values.size());
  for (const double value : values) deviations.push_back(std::abs(value - median));
  const double mad = median_of(deviations);
  std::vector<std::size_t> outliers;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (mad > 0 && normal_quartile * deviations[i] > outlier_score * mad) outliers.push_back(i);
  return outliers;
}

}  // namespace photonproof::inline harness_statistics
