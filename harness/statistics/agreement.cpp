#include "harness/statistics/agreement.h"

#include <algorithm>
#include <array>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <cstdio>
#include <vector>

#include "harness/pixels/image_blocks.h"
#include "harness/statistics/block_variance.h"
#include "harness/statistics/deviation.h"
#include "harness/statistics/picture_noise.h"
#include "harness/statistics/student.h"
#include "harness/statistics/weighed_mean.h"
#include "scenes/base/input_error.h"
#include "scenes/base/percent_text.h"
#include "scenes/images/mean_error.h"

namespace photonproof::inline harness_statistics {
namespace {

constexpr const char* kChannels[] = {"R", "G", "B"};

/// One channel of both images: differences and their variances.
struct Differences {
  int width, height;
  std::vector<double> difference, variance;
  std::vector<double> shared{};  ///< The pixel's part of the variance of a sum: more where splats span pixels.

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
};

Differences differences(const Rendering& reference, const Rendering& test, std::size_t channel) {
  Differences d{reference.mean.width, reference.mean.height, {}, {}};
  const double of_reference = pixels_a_splat(reference), of_test = pixels_a_splat(test);
  const std::size_t pixels = reference.mean.pixels();
  d.difference.reserve(pixels);
  d.variance.reserve(pixels);
  for (std::size_t i = channel; i < 3 * pixels; i += 3) {
    const double r = double{reference.mean.rgb[i]}, x = double{test.mean.rgb[i]};
    const double rounding = rounding_deviation * std::max(std::abs(r), std::abs(x));
    d.difference.push_back(x - r);
    const double reference_variance = double{reference.variance->rgb[i]}, test_variance = double{test.variance->rgb[i]};
    d.variance.push_back(reference_variance + test_variance + rounding * rounding);
    d.shared.push_back(of_reference * reference_variance + of_test * test_variance + rounding * rounding);
  }
  return d;
}

double sum_over(const Block& block, const Differences& d, const std::vector<double>& values) {
  double sum = 0;
  for_each_pixel(block, [&](int x, int y) { sum += values[d.index(x, y)]; });
  return sum;
}

Deviation block_deviation(const Block& block, const Differences& d) {
  const KnownVariance known = known_over(block, [&](int x, int y) { return d.shared[d.index(x, y)]; });
  Deviation deviation;
  deviation.difference = sum_over(block, d, d.difference);
  deviation.standard_error = std::sqrt(known.variance);
  deviation.freedom = known.freedom;
  return deviation;
}

template <class... Values>
std::string text(const char* format, Values... values) {
  std::array<char, 256> buffer{};
  std::snprintf(buffer.data(), buffer.size(), format, values...);
  return buffer.data();
}

StatisticalVerdict test_all_pixels(const std::array<Differences, 3>& channels, const Rendering& reference,
                                   const Rendering& test, double alpha, double freedom) {
  StatisticalVerdict verdict;
  verdict.n = 3 * reference.mean.pixels();
  verdict.alpha = sidak(alpha, static_cast<double>(verdict.n));
  verdict.bound = -boost::math::quantile(boost::math::normal(), verdict.alpha / 2);
  std::size_t beyond = 0, channel = 0, worst_channel = 0;
  int worst_x = 0, worst_y = 0;
  for (const Differences& d : channels) {
    for (const Block& block : blocks_of(d.width, d.height)) {
      const double least = sum_over(block, d, d.variance) / block.pixels();
      const double shape =
          6 / relative_spread_of_variance(block, [&](int x, int y) { return d.variance[d.index(x, y)]; });
      for_each_pixel(block, [&](int x, int y) {
        const double variance = std::max(least, d.variance[d.index(x, y)]);
        const double t = variance > 0 ? std::abs(d.difference[d.index(x, y)]) / std::sqrt(variance) : 0;
        const double deviate = normal_deviate(gamma_deviate(t, shape), freedom);
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

/// Subtracts from the blocks the deviation that all pixels of `rendering` have in common, in proportion to their
/// standard deviations. The amount is the weighted least-squares fit. The test of the whole image judges this common
/// part. The rest varies by (1 - c) of the variances; it is tested against the full variances because c is an estimate,
/// too.
void take_out_what_is_common(const Rendering& rendering, std::size_t channel, const std::vector<Block>& places,
                             std::vector<Deviation>& blocks) {
  if (correlation_of_pixels(rendering, channel) == 0) return;
  std::vector<double> common;
  double shared = 0, squares = 0;
  for (std::size_t b = 0; b < places.size(); ++b) {
    double roots = 0;
    for_each_pixel(places[b],
                   [&](int x, int y) { roots += std::sqrt(double{rendering.variance->pixel(x, y)[channel]}); });
    common.push_back(roots);
    const double variance = std::pow(blocks[b].standard_error, 2);
    if (!(variance > 0)) continue;
    shared += roots * blocks[b].difference / variance;
    squares += roots * roots / variance;
  }
  if (!(squares > 0)) return;
  for (std::size_t b = 0; b < places.size(); ++b) blocks[b].difference -= shared / squares * common[b];
}

StatisticalVerdict test_blocks(const std::array<Differences, 3>& channels, const Rendering& reference,
                               const Rendering& test, double alpha) {
  const std::vector<Block> places = blocks_of(reference.mean.width, reference.mean.height);
  std::array<std::vector<Deviation>, 3> blocks;
  for (std::size_t channel = 0; channel < 3; ++channel) {
    for (const Block& place : places) blocks[channel].push_back(block_deviation(place, channels[channel]));
    take_out_what_is_common(test, channel, places, blocks[channel]);
    take_out_what_is_common(reference, channel, places, blocks[channel]);
  }
  const BlockChiSquare chi_square = chi_square_of_blocks(blocks, alpha);
  const std::vector<Deviation>& shown = blocks[chi_square.channel];
  const auto size = [](const Deviation& block) { return std::abs(block.deviate()); };
  const auto worst =
      std::max_element(shown.begin(), shown.end(), [&](const auto& a, const auto& b) { return size(a) < size(b); });
  const Block& where = places[static_cast<std::size_t>(worst - shown.begin())];
  double expected = 0;
  for_each_pixel(where, [&](int x, int y) { expected += double{reference.mean.pixel(x, y)[chi_square.channel]}; });
  StatisticalVerdict verdict;
  verdict.n = places.size();
  verdict.alpha = sidak(alpha, 3);
  verdict.observed = chi_square.value;
  verdict.bound = chi_square.bound;
  verdict.pass = !chi_square.beyond();
  verdict.sentence =
      text("%s of %zu blocks: chi^2 %.4g, bound %.4g; worst at (%d, %d): %+.3g %% of %.4g, %.3g deviations",
           kChannels[chi_square.channel], places.size(), chi_square.value, chi_square.bound, where.x0, where.y0,
           expected != 0 ? 100 * worst->difference / expected : INFINITY, expected / where.pixels(), size(*worst));
  return verdict;
}

/// The minimum relative error d that a two-sided test of level `alpha` finds with probability `power`. It exceeds both
/// quantiles, d r = q sqrt(v_r + (1 + d)^2 v_x), because a brighter image also has more noise. Infinite where the test
/// finds no error that often. Preconditions: the reference is not 0; `difference` is of the two images.
double least_seen(const Deviation& difference, const KnownVariance& of_test, double alpha, double power) {
  const double q = difference.margin(alpha / 2) + difference.margin(1 - power);
  const double reference = std::pow(difference.expected, 2), variance = std::pow(difference.standard_error, 2);
  const double x = q * q * of_test.variance / variance / reference, r = q * q / reference - x;
  return x < 1 ? (x + std::sqrt(x * x + (1 - x) * (r + x))) / (1 - x) : INFINITY;
}

constexpr const char* not_judged = "not judged: pixels of an image share noise";

/// The plain mean of a channel. Where pixels share noise its variance is the one that the image states; else empty.
std::optional<ChannelMean> plain_mean(const Rendering& rendering, std::size_t channel, bool shares_noise) {
  const auto pixels = static_cast<double>(rendering.mean.pixels());
  ChannelMean mean;
  double variance = 0;
  for (std::size_t i = channel; i < rendering.mean.rgb.size(); i += 3) {
    mean.value += double{rendering.mean.rgb[i]} / pixels;
    variance += double{rendering.variance->rgb[i]};
  }
  const auto stored = stored_mean_error(rendering);
  if (stored)
    mean.known = {std::pow(stored->standard_error[channel], 2), stored->passes - 1};
  else if (shares_noise)
    return std::nullopt;
  else
    mean.known.variance = variance / (pixels * pixels);
  return mean;
}

/// The passes behind the images' variances, less one; infinite where no image states them.
double freedom_of_passes(const Rendering& reference, const Rendering& test) {
  double freedom = INFINITY;
  for (const Rendering* rendering : {&reference, &test})
    if (const auto stored = stored_mean_error(*rendering)) freedom = std::min(freedom, stored->passes - 1);
  return freedom;
}

/// Sets `seen` to the minimum detectable error.
template <class MeansOf>
StatisticalVerdict test_whole(const MeansOf& means_of, double alpha, std::optional<double>& seen) {
  StatisticalVerdict verdict;
  verdict.n = 3;
  verdict.alpha = sidak(alpha, 3);
  verdict.bound = -boost::math::quantile(boost::math::normal(), verdict.alpha / 2);
  double worst = -1;
  for (std::size_t channel = 0; channel < 3; ++channel) {
    const auto [of_reference, of_test] = means_of(channel);
    const Deviation d = deviation_of(of_test.value, of_reference.value, of_test.known, of_reference.known);
    if (d.expected != 0)
      seen = std::max(seen.value_or(0), least_seen(d, of_test.known, verdict.alpha, Agreement::power));
    const double deviate = std::abs(d.deviate());
    if (deviate <= worst) continue;
    worst = verdict.observed = deviate;
    verdict.sentence = text("%s of the whole image: %+.3g %%, %.3g deviations, bound %.3g", kChannels[channel],
                            d.expected != 0 ? 100 * d.difference / d.expected : INFINITY, deviate, verdict.bound);
  }
  verdict.pass = verdict.observed <= verdict.bound;
  return verdict;
}

void check_variance(const Rendering& rendering, const char* name) {
  if (!rendering.variance)
    throw InputError(name, "the image has no channels variance.R, variance.G, variance.B, which agreement needs");
}

}  // namespace

std::string Agreement::power_sentence() const {
  if (shared_noise && whole.n == 0)
    return "the image does not state the standard error of its mean, so no error could be detected";
  if (!would_see) return "the whole image is black: no error of its brightness could have been seen";
  if (std::isinf(*would_see)) return "too noisy for any error of the whole image to be seen";
  return "an error of " + percent_text(*would_see) + " of the whole image would have been seen " +
         text("(probability %g)", power);
}

Agreement test_agreement(const Rendering& reference, const Rendering& test, double alpha, bool shared_noise) {
  check_variance(reference, "reference");
  check_variance(test, "test");
  const std::array<Differences, 3> channels{differences(reference, test, 0), differences(reference, test, 1),
                                            differences(reference, test, 2)};
  const double part = sidak(alpha, 3);
  Agreement agreement;
  agreement.shared_noise = shared_noise || shares_photons(reference) || shares_photons(test);
  if (!agreement.shared_noise) {
    agreement.pixels = test_all_pixels(channels, reference, test, part, INFINITY);
    agreement.blocks = test_blocks(channels, reference, test, part);
    const auto weighted = [&](std::size_t channel) {
      const PixelWeights weight(reference, test, channel);
      return std::pair(weighed_mean(reference, channel, weight), weighed_mean(test, channel, weight));
    };
    agreement.whole = test_whole(weighted, part, agreement.would_see);
    return agreement;
  }
  agreement.pixels = test_all_pixels(channels, reference, test, part, freedom_of_passes(reference, test));
  agreement.blocks.sentence = agreement.whole.sentence = not_judged;
  const auto plain = [&](std::size_t channel) {
    return std::pair(plain_mean(reference, channel, shared_noise || shares_photons(reference)),
                     plain_mean(test, channel, shared_noise || shares_photons(test)));
  };
  if (plain(0).first && plain(0).second)
    agreement.whole = test_whole([&](std::size_t c) { return std::pair(*plain(c).first, *plain(c).second); }, part,
                                 agreement.would_see);
  else
    agreement.inconclusive = agreement.pixels.pass;
  return agreement;
}

}  // namespace photonproof::inline harness_statistics
