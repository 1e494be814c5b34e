#include "harness/statistics/picture_noise.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "harness/statistics/block_variance.h"
#include "harness/statistics/brightest_sample.h"
#include "harness/statistics/weighed_mean.h"
#include "scenes/images/mean_error.h"

namespace photonproof::inline harness_statistics {
namespace {

/// One channel of a picture with a variance layer.
class LayerNoise {
 public:
  LayerNoise(const Rendering& rendering, std::size_t channel, Deviations& out)
      : rendering_(rendering),
        c_(channel),
        out_(out),
        splat_(pixels_a_splat(rendering)),
        correlation_(shares_photons(rendering) ? 1 : correlation_of_pixels(rendering, channel)) {
    if (correlation_ > 0 && !shares_photons(rendering)) freedom_ = stored_mean_error(rendering)->passes - 1;
    const Block all{0, 0, out.width, out.height};
    brightness_ = brightness_of(all);
  }

  /// Call before `measure`: the samples of this channel count for all three.
  void add_to(BrightestSample& brightest) const {
    for (const Block& block : out_.places) brightest.add(brightest_in(block), brightness_of(block), brightness_);
  }

  void measure(const BrightestSample& brightest) {
    out_.pixels[c_].resize(rendering_.mean.pixels());
    double shared = 0, shared_squared = 0;
    for (const Block& block : out_.places) {
      const double sample = brightest.missed_by(brightness_of(block), brightness_);
      measure_pixels(block, sample);
      out_.blocks[c_].push_back(sum_over(block, sample));
      const double ratio = std::pow(roots_over(block) / block.pixels() / out_.blocks[c_].back().standard_error, 2);
      if (!std::isfinite(ratio)) continue;
      shared += ratio;
      shared_squared += ratio * ratio;
    }
    // Blocks a and b correlate by c R_a R_b / (s_a s_b), R = sum sqrt v; Satterthwaite as in shared_noise.h.
    const auto count = static_cast<double>(out_.places.size());
    const double pairs = correlation_ * correlation_ * std::max(0.0, shared * shared - shared_squared);
    out_.independent_blocks[c_] = std::clamp(count * count / (count + pairs), 1.0, count);
    measure_whole(brightest.missed_by(brightness_, brightness_));
  }

 private:
  double value(int x, int y) const { return double{rendering_.mean.pixel(x, y)[c_]}; }
  double variance(int x, int y) const { return double{rendering_.variance->pixel(x, y)[c_]}; }

  double brightness_of(const Block& block) const {
    double sum = 0;
    for_each_pixel(block, [&](int x, int y) { sum += value(x, y); });
    return std::abs(sum) / block.pixels();
  }

  double roots_over(const Block& block) const {
    double sum = 0;
    for_each_pixel(block, [&](int x, int y) { sum += std::sqrt(variance(x, y)); });
    return sum;
  }

  /// A layer's variances may be a block's, and then a dark pixel's is not from one sample. So the result is at most its
  /// root.
  double brightest_in(const Block& block) const {
    double most = 0;
    for_each_pixel(block, [&](int x, int y) {
      const double v = variance(x, y);
      if (v > 0) most = std::max(most, v / std::max(value(x, y), std::sqrt(v)));
    });
    return most;
  }

  void measure_pixels(const Block& block, double sample) {
    const auto of_pixel = [&](int x, int y) { return variance(x, y); };
    const double least = known_over(block, of_pixel).variance / block.pixels();
    const double kurtosis = relative_spread_of_variance(block, of_pixel);
    for_each_pixel(block, [&](int x, int y) {
      Deviation& pixel = out_.pixels[c_][static_cast<std::size_t>(y * out_.width + x)];
      pixel = deviation_of(value(x, y), value(x, y), {std::max(least, variance(x, y))}, {});
      pixel.skewness = 2 * std::sqrt(kurtosis / 6);  // as Gamma's of that excess kurtosis
      pixel.sample = sample;
    });
  }

  Deviation sum_over(const Block& block, double sample) const {
    const KnownVariance own = known_over(block, [&](int x, int y) { return splat_ * variance(x, y); });
    const double roots = roots_over(block), common = std::max(0.0, correlation_ * (roots * roots - own.variance));
    KnownVariance known{own.variance + common};
    const double doubt =
        std::pow(own.variance / known.variance, 2) / own.freedom + std::pow(common / known.variance, 2) / freedom_;
    if (doubt > 0) known.freedom = 1 / doubt;
    known.variance /= block.pixels() * block.pixels();
    double sum = 0;
    for_each_pixel(block, [&](int x, int y) { sum += value(x, y); });
    Deviation deviation = deviation_of(sum / block.pixels(), sum / block.pixels(), known, {});
    deviation.sample = splat_ * sample / block.pixels();
    return deviation;
  }

  /// Uses the stated error of the image's mean, or the pixels' variances where these give more. Where pixels gather the
  /// same photons, their variances do not count, and without a stated error they count as fully correlated.
  void measure_whole(double sample) {
    const Block all{0, 0, out_.width, out_.height};
    Deviation& whole = out_.whole[c_] = sum_over(all, sample);
    const auto stored = stored_mean_error(rendering_);
    if (!stored) return;
    KnownVariance known = known_over(all, [&](int x, int y) { return variance(x, y); });
    known.variance /= all.pixels() * all.pixels();
    const double stated = std::pow(stored->standard_error[c_], 2);
    if (shares_photons(rendering_) || stated > known.variance) known = {stated, std::max(1.0, stored->passes - 1)};
    whole.standard_error = deviation_of(whole.expected, whole.expected, known, {}).standard_error;
    whole.freedom = known.freedom;
  }

  const Rendering& rendering_;
  std::size_t c_;
  Deviations& out_;
  double splat_, correlation_;
  double freedom_ = std::numeric_limits<double>::infinity();  ///< degrees of freedom of the correlation
  double brightness_ = 0;                                     ///< mean over the image
};

Deviations noise_by_layer(const Rendering& rendering) {
  Deviations out;
  out.width = rendering.mean.width;
  out.height = rendering.mean.height;
  out.images = 1;
  out.places = blocks_of(out.width, out.height);
  std::vector<LayerNoise> channels;
  for (std::size_t c = 0; c < 3; ++c) channels.emplace_back(rendering, c, out);
  BrightestSample brightest;
  for (const LayerNoise& channel : channels) channel.add_to(brightest);
  for (LayerNoise& channel : channels) channel.measure(brightest);
  return out;
}

/// The images against their own mean.
Deviations noise_by_images(const Rendering& rendering, std::span<const Image> images) {
  std::vector<const Image*> pointers;
  for (const Image& image : images) pointers.push_back(&image);
  const Rendering mean{rendering.mean, Image(rendering.mean.width, rendering.mean.height), {}};
  return measure_deviations(mean, pointers, {.reference_freedom = std::numeric_limits<double>::infinity()});
}

/// The excess kurtosis of a Gamma variable is 3/2 of its squared skewness; kurtoses add with the squared variances.
Deviation difference_of(const Deviation& first, const Deviation& second) {
  const double of_first = std::pow(first.standard_error, 2), of_second = std::pow(second.standard_error, 2);
  const double variance = of_first + of_second;
  Deviation d{second.expected - first.expected, std::sqrt(variance)};
  d.expected = first.expected;
  d.two_sided = true;
  d.sample = std::max(first.sample, second.sample);
  if (!(variance > 0)) return d;
  const double share = std::pow(of_first / variance, 2), rest = std::pow(of_second / variance, 2);
  const double doubt = share / first.freedom + rest / second.freedom;
  if (doubt > 0) d.freedom = 1 / doubt;
  d.skewness = std::sqrt(share * std::pow(first.skewness, 2) + rest * std::pow(second.skewness, 2));
  return d;
}

/// The sample of a block counts in proportion to its weight in the mean. Precondition: blocks and pixels are measured.
Deviation weighed_difference(const Rendering& first, const Rendering& second, std::size_t channel,
                             const Deviations& between) {
  const PixelWeights weight(first, second, channel);
  const ChannelMean of_first = weighed_mean(first, channel, weight), of_second = weighed_mean(second, channel, weight);
  Deviation d = deviation_of(of_second.value, of_first.value, of_second.known, of_first.known);
  d.two_sided = true;
  for (std::size_t b = 0; b < between.places.size(); ++b)
    d.sample =
        std::max(d.sample, weight.largest_in(b) * between.places[b].pixels() * between.blocks[channel][b].sample);
  return d;
}

bool has_layer(const NoisyPicture& picture) { return picture.images.empty() && !shares_photons(picture.rendering); }

std::vector<Deviation> differences_of(const std::vector<Deviation>& first, const std::vector<Deviation>& second) {
  std::vector<Deviation> all;
  all.reserve(first.size());
  for (std::size_t i = 0; i < first.size(); ++i) all.push_back(difference_of(first[i], second[i]));
  return all;
}

}  // namespace

double correlation_of_pixels(const Rendering& rendering, std::size_t channel) {
  const auto stored = stored_mean_error(rendering);
  if (!stored) return 0;
  double sum = 0, roots = 0;
  for (std::size_t i = channel; i < rendering.variance->rgb.size(); i += 3) {
    sum += double{rendering.variance->rgb[i]};
    roots += std::sqrt(double{rendering.variance->rgb[i]});
  }
  if (roots * roots <= sum) return 0;
  const double shown = std::pow(stored->standard_error[channel] * static_cast<double>(rendering.mean.pixels()), 2);
  return std::clamp((shown - sum) / (roots * roots - sum), 0.0, 1.0);
}

Deviations noise_of(const NoisyPicture& picture) {
  return picture.images.size() < 2 ? noise_by_layer(picture.rendering)
                                   : noise_by_images(picture.rendering, picture.images);
}

Deviations deviations_between(const NoisyPicture& first, const NoisyPicture& second) {
  const Deviations of_first = noise_of(first), of_second = noise_of(second);
  Deviations out;
  out.width = of_first.width;
  out.height = of_first.height;
  out.images = std::min(of_first.images, of_second.images);
  out.places = of_first.places;
  for (std::size_t c = 0; c < 3; ++c) {
    out.pixels[c] = differences_of(of_first.pixels[c], of_second.pixels[c]);
    out.blocks[c] = differences_of(of_first.blocks[c], of_second.blocks[c]);
    out.whole[c] = difference_of(of_first.whole[c], of_second.whole[c]);
    out.independent_blocks[c] = std::min(of_first.independent_blocks[c], of_second.independent_blocks[c]);
  }
  if (!has_layer(first) || !has_layer(second)) return out;
  out.weighed.emplace();
  for (std::size_t c = 0; c < 3; ++c) (*out.weighed)[c] = weighed_difference(first.rendering, second.rendering, c, out);
  return out;
}

}  // namespace photonproof::inline harness_statistics
