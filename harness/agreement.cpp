#include "harness/agreement.h"

#include <algorithm>
#include <array>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <cstdio>
#include <vector>

#include "harness/image_blocks.h"
#include "harness/student.h"
#include "scenes/input_error.h"

namespace photonproof {
namespace {

constexpr double kRounding = 1e-5;
constexpr const char* kChannels[] = {"R", "G", "B"};

/// One channel of both images: differences and their variances.
struct Differences {
  int width, height;
  std::vector<double> difference, variance;

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
};

Differences differences(const Rendering& reference, const Rendering& test, std::size_t channel) {
  Differences d{reference.mean.width, reference.mean.height, {}, {}};
  const std::size_t pixels = reference.mean.pixels();
  d.difference.reserve(pixels);
  d.variance.reserve(pixels);
  for (std::size_t i = channel; i < 3 * pixels; i += 3) {
    const double r = double{reference.mean.rgb[i]}, x = double{test.mean.rgb[i]};
    const double rounding = kRounding * std::max(std::abs(r), std::abs(x));
    d.difference.push_back(x - r);
    d.variance.push_back(double{reference.variance->rgb[i]} + double{test.variance->rgb[i]} + rounding * rounding);
  }
  return d;
}

double sum_over(const Block& block, const Differences& d, const std::vector<double>& values) {
  double sum = 0;
  for_each_pixel(block, [&](int x, int y) { sum += values[d.index(x, y)]; });
  return sum;
}

/// Relative deviation squared of the block's variances, from their median and median absolute deviation, so that an
/// edge or a lamp in the block does not count.
double relative_spread_of_variance(const Block& block, const Differences& d) {
  std::vector<double> values;
  for_each_pixel(block, [&](int x, int y) { values.push_back(d.variance[d.index(x, y)]); });
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  const double median = *middle;
  for (double& value : values) value = std::abs(value - median);
  std::nth_element(values.begin(), middle, values.end());
  constexpr double of_normal = 1.4826;  // deviation over median absolute deviation
  return median > 0 ? std::pow(of_normal * *middle / median, 2) : 0;
}

double block_deviate(const Block& block, const Differences& d) {
  const double variance = sum_over(block, d, d.variance);
  if (variance == 0) return 0;  // black in both
  const double mean = variance / block.pixels();
  double spread = 0;
  for_each_pixel(block, [&](int x, int y) {
    const double off = d.variance[d.index(x, y)] - mean;
    spread += off * off;
  });
  const double unbiased = spread * block.pixels() / std::max(1.0, block.pixels() - 1);
  const double freedom = unbiased > 0 ? 2 * variance * variance / unbiased : INFINITY;
  return normal_deviate(sum_over(block, d, d.difference) / std::sqrt(variance), freedom);
}

template <class... Values>
std::string text(const char* format, Values... values) {
  std::array<char, 256> buffer{};
  std::snprintf(buffer.data(), buffer.size(), format, values...);
  return buffer.data();
}

StatisticalVerdict test_pixels(const std::array<Differences, 3>& channels, const Rendering& reference,
                               const Rendering& test, double alpha) {
  StatisticalVerdict verdict;
  verdict.n = 3 * reference.mean.pixels();
  verdict.alpha = sidak(alpha, static_cast<double>(verdict.n));
  verdict.bound = -boost::math::quantile(boost::math::normal(), verdict.alpha / 2);
  std::size_t beyond = 0, channel = 0, worst_channel = 0;
  int worst_x = 0, worst_y = 0;
  for (const Differences& d : channels) {
    for (const Block& block : blocks_of(d.width, d.height)) {
      const double least = sum_over(block, d, d.variance) / block.pixels();
      const double shape = 6 / relative_spread_of_variance(block, d);
      for_each_pixel(block, [&](int x, int y) {
        const double variance = std::max(least, d.variance[d.index(x, y)]);
        const double t = variance > 0 ? std::abs(d.difference[d.index(x, y)]) / std::sqrt(variance) : 0;
        const double deviate = gamma_deviate(t, shape);
        if (deviate > verdict.bound) ++beyond;
        if (deviate <= verdict.observed) return;
        verdict.observed = deviate;
        worst_x = x;
        worst_y = y;
        worst_channel = channel;
      });
    }
    ++channel;
  }
  verdict.pass = beyond == 0;
  verdict.sentence =
      text("pixel (%d, %d) %s is %.6g, reference %.6g: %.3g deviations, bound %.3g; %zu of %zu values beyond", worst_x,
           worst_y, kChannels[worst_channel], double{test.mean.pixel(worst_x, worst_y)[worst_channel]},
           double{reference.mean.pixel(worst_x, worst_y)[worst_channel]}, verdict.observed, verdict.bound, beyond,
           verdict.n);
  return verdict;
}

StatisticalVerdict test_blocks(const std::array<Differences, 3>& channels, const Rendering& reference, double alpha) {
  const std::vector<Block> blocks = blocks_of(reference.mean.width, reference.mean.height);
  StatisticalVerdict verdict;
  verdict.n = blocks.size();
  verdict.alpha = sidak(alpha, 3);
  verdict.bound = boost::math::quantile(
      boost::math::complement(boost::math::chi_squared(static_cast<double>(blocks.size())), verdict.alpha));
  for (std::size_t channel = 0; channel < 3; ++channel) {
    const Differences& d = channels[channel];
    double chi_square = 0, worst = -1;
    Block where{};
    for (const Block& block : blocks) {
      const double deviate = block_deviate(block, d);
      chi_square += deviate * deviate;
      if (deviate <= worst) continue;
      worst = deviate;
      where = block;
    }
    if (chi_square < verdict.observed && channel > 0) continue;
    verdict.observed = chi_square;
    double expected = 0;
    for_each_pixel(where, [&](int x, int y) { expected += double{reference.mean.pixel(x, y)[channel]}; });
    const double off = sum_over(where, d, d.difference);
    verdict.sentence =
        text("%s of %zu blocks: chi^2 %.4g, bound %.4g; worst at (%d, %d): %+.3g %% of %.4g, %.3g deviations",
             kChannels[channel], blocks.size(), chi_square, verdict.bound, where.x0, where.y0,
             expected != 0 ? 100 * off / expected : INFINITY, expected / where.pixels(), worst);
  }
  verdict.pass = verdict.observed <= verdict.bound;
  return verdict;
}

void check_variance(const Rendering& rendering, const char* name) {
  if (!rendering.variance)
    throw InputError(name, "the image has no channels variance.R, variance.G, variance.B, which agreement needs");
}

}  // namespace

Agreement test_agreement(const Rendering& reference, const Rendering& test, double alpha) {
  check_variance(reference, "reference");
  check_variance(test, "test");
  const std::array<Differences, 3> channels{differences(reference, test, 0), differences(reference, test, 1),
                                            differences(reference, test, 2)};
  return {test_pixels(channels, reference, test, alpha), test_blocks(channels, reference, alpha)};
}

}  // namespace photonproof
