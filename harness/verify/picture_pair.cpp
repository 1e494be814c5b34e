#include "harness/verify/picture_pair.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <limits>

#include "harness/metrics/metrics.h"
#include "harness/statistics/agreement.h"
#include "harness/statistics/block_variance.h"
#include "harness/statistics/gate_tiles.h"
#include "scenes/images/mean_error.h"

namespace photonproof {
namespace {

/// Nothing at all is known to be less certain than that.
constexpr double kNoDeviation = 1e9;

double variance_of(const EnginePicture& picture, std::size_t value) {
  return picture.rendering.variance ? double{picture.rendering.variance->rgb[value]} : 0;
}

const Deviation& pixel_of(const Deviations& d, int x, int y, std::size_t channel) {
  return d
      .pixels[channel][static_cast<std::size_t>(y) * static_cast<std::size_t>(d.width) + static_cast<std::size_t>(x)];
}

Deviation sum_of(const Deviations& d, const Block& block, std::size_t channel) {
  Deviation sum;
  for_each_pixel(block, [&](int x, int y) {
    sum.difference += pixel_of(d, x, y, channel).difference;
    sum.expected += pixel_of(d, x, y, channel).expected;
  });
  const KnownVariance known =
      known_over(block, [&](int x, int y) { return std::pow(pixel_of(d, x, y, channel).standard_error, 2); });
  sum.standard_error = std::sqrt(known.variance);
  sum.freedom = known.freedom;
  return sum;
}

/// Pixels that share light paths vary together, which only their mean's own error knows.
void widen_by_mean_error(Deviation& whole, const EnginePicture& picture, std::size_t channel) {
  const auto stored = stored_mean_error(picture.rendering);
  if (!stored) return;
  double sum = 0;
  for (std::size_t i = channel; i < picture.rendering.mean.rgb.size(); i += 3) sum += variance_of(picture, i);
  const double shown = std::pow(stored->standard_error[channel] * double(picture.rendering.mean.pixels()), 2);
  if (shown <= sum) return;
  whole.standard_error = std::sqrt(std::pow(whole.standard_error, 2) + shown - sum);
  whole.freedom = std::min(whole.freedom, std::max(1.0, stored->passes - 1));
}

/// Neighbours that a light path's splat spans vary together.
void widen_by_splats(Deviation& sum, const EnginePicture& picture, const Block& block, std::size_t channel) {
  const double more = pixels_a_splat(picture.rendering) - 1;
  if (!(more > 0)) return;
  double variance = 0;
  for_each_pixel(block, [&](int x, int y) { variance += double{picture.rendering.variance->pixel(x, y)[channel]}; });
  sum.standard_error = std::sqrt(std::pow(sum.standard_error, 2) + more * variance);
}

double whole_level() { return sidak(pair_alpha, 6); }

/// The least shift of the mean, relative, that shows beyond what is declared.
double least_shift(const Deviation& whole, double declared) {
  if (whole.expected == 0) return 0;
  return declared + (whole.margin(whole_level() / 2) + whole.margin(1 - Agreement::power)) / std::abs(whole.expected);
}

bool whole_is_beyond(const Deviation& whole, double declared) {
  return std::abs(whole.difference) > declared * std::abs(whole.expected) + whole.margin(whole_level() / 2);
}

double relmse_of(const Image& reference, const Image& test) {
  double sum = 0;
  for (std::size_t i = 0; i < reference.rgb.size(); ++i) {
    const double r = double{reference.rgb[i]}, x = double{test.rgb[i]};
    sum += (x - r) * (x - r) / (r * r + 0.01);
  }
  return sum / static_cast<double>(std::max<std::size_t>(1, reference.rgb.size()));
}

std::optional<double> ssim_of(const Image& reference, const Image& test) {
  MetricOptions options;
  options.only = {"ssim"};
  options.threads = 1;
  for (const MetricValue& value : compute_metrics(reference, test, options))
    if (value.name == "ssim") return value.value;
  return std::nullopt;
}

EnginePicture without_noise(EnginePicture picture) {
  picture.rendering.variance = Image(picture.rendering.mean.width, picture.rendering.mean.height);
  picture.rendering.metadata.clear();
  return picture;
}

/// The sum over these channels, of all where there is none.
Deviation whole_of(const Deviations& d, const std::array<bool, 3>& channels) {
  const bool any = channels[0] || channels[1] || channels[2];
  Deviation whole;
  for (std::size_t c = 0; c < 3; ++c) {
    if (any && !channels[c]) continue;
    whole.difference += d.whole[c].difference;
    whole.expected += d.whole[c].expected;
  }
  return whole;
}

double relative_shift(const Deviation& whole) {
  return whole.expected != 0 ? whole.difference / std::abs(whole.expected) : 0;
}

std::string whole_sentence(const Deviations& d, const std::array<bool, 3>& channels) {
  const Deviation whole = whole_of(d, channels);
  const std::string names = channel_names(channels);
  return relative_text(whole.difference, whole.expected) + " over the whole image" +
         (names.empty() ? "" : ", " + names + " only");
}

void compare_channels(const Deviations& d, const DeclaredError& declared, PairTest& test) {
  for (std::size_t c = 0; c < 3; ++c) {
    const Deviation& whole = d.whole[c];
    if (whole.expected != 0) {
      test.shift[c] = whole.difference / std::abs(whole.expected);
      test.would_see = std::max(test.would_see.value_or(0), least_shift(whole, declared.whole));
    }
    if (!whole_is_beyond(whole, declared.whole)) continue;
    test.whole_differs = test.channels[c] = true;
  }
}

void name_places(const Deviations& d, PairTest& test) {
  if (!test.differs) return;
  const std::string place = test.tiles.empty() ? "" : test.tiles.front().sentence;
  const bool everywhere =
      !test.tiles.empty() && test.tiles.front().width * test.tiles.front().height * 4 >= 3 * d.width * d.height;
  if (test.whole_differs && (test.tiles.empty() || everywhere))
    test.sentence = whole_sentence(d, test.channels);
  else if (!place.empty())
    test.sentence = place;
  if (!test.whole_differs || test.sentence == place || place.empty() || everywhere) return;
  test.sentence += "; " + place;
}

}  // namespace

Deviations deviations_between(const EnginePicture& first, const EnginePicture& second) {
  const Image &a = first.rendering.mean, &b = second.rendering.mean;
  Deviations d;
  d.width = a.width;
  d.height = a.height;
  d.images = 1;
  d.places = blocks_of(a.width, a.height);
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t i = c; i < a.rgb.size(); i += 3) {
      const double r = double{a.rgb[i]}, x = double{b.rgb[i]};
      const double rounding = rounding_deviation * std::max(std::abs(r), std::abs(x));
      Deviation pixel;
      pixel.difference = x - r;
      pixel.expected = r;
      pixel.standard_error = std::sqrt(variance_of(first, i) + variance_of(second, i) + rounding * rounding);
      d.pixels[c].push_back(pixel);
    }
    for (const Block& block : d.places) {
      d.blocks[c].push_back(sum_of(d, block, c));
      for (const EnginePicture* picture : {&first, &second}) widen_by_splats(d.blocks[c].back(), *picture, block, c);
    }
    d.whole[c] = sum_of(d, {0, 0, a.width, a.height}, c);
    for (const EnginePicture* picture : {&first, &second}) widen_by_mean_error(d.whole[c], *picture, c);
  }
  return d;
}

double excess_of_block(const Deviations& d, const DeclaredError& declared, std::size_t block, std::size_t channel) {
  const Deviation& off = d.blocks[channel][block];
  const double pixels = static_cast<double>(d.width) * d.height;
  const double usual = std::abs(d.whole[channel].expected) * d.places[block].pixels() / pixels;
  const double allowed = declared.block * std::max(std::abs(off.expected), usual);
  const double tests = 3 * static_cast<double>(d.places.size());
  const double beyond = std::abs(off.difference) - allowed;
  if (beyond <= off.margin(sidak(pair_alpha, tests) / 2)) return 0;
  return off.standard_error > 0 ? beyond / off.standard_error : kNoDeviation;
}

DeclaredError both_declare(const EnginePicture& first, const EnginePicture& second) {
  return {first.declared.whole + second.declared.whole, first.declared.block + second.declared.block, ""};
}

namespace {

PairTest test_by_known_noise(const EnginePicture& first, const EnginePicture& second, double alpha) {
  PairTest test;
  const DeclaredError declared = both_declare(first, second);
  const Deviations d = deviations_between(first, second);
  compare_channels(d, declared, test);
  test.tiles = failing_tiles(d, [&](std::size_t b, std::size_t c) { return excess_of_block(d, declared, b, c); });
  test.differs = test.whole_differs || !test.tiles.empty();
  if (declared.is_exact()) {
    const Agreement agreement = test_agreement(first.rendering, second.rendering, alpha);
    test.differs = !agreement.pass();
    test.would_see = agreement.would_see;
    if (test.differs)
      test.sentence = !agreement.whole.pass    ? agreement.whole.sentence
                      : !agreement.blocks.pass ? agreement.blocks.sentence
                                               : agreement.pixels.sentence;
    if (!test.differs) test.tiles.clear();
  }
  for (std::size_t b = 0; test.differs && b < d.places.size(); ++b)
    for (std::size_t c = 0; c < 3; ++c)
      if (excess_of_block(d, declared, b, c) > 0) test.channels[c] = true;
  name_places(d, test);
  test.whole_shift = relative_shift(whole_of(d, test.channels));
  return test;
}

/// Marks the pixel of this picture that has more light than chance gives it beside `other`, its light in each channel.
void find_outlier(const EnginePicture& picture, const std::array<double, 3>& light, double alpha, PairTest& test) {
  const Image& mean = picture.rendering.mean;
  for (std::size_t i = 0; i < mean.rgb.size(); ++i) {
    const std::size_t c = i % 3, pixel = i / 3, width = static_cast<std::size_t>(mean.width);
    const double times = 6 / alpha;
    if (!(light[c] > 0) || double{mean.rgb[i]} <= times * light[c]) continue;
    test.differs = test.has_outlier = test.channels[c] = true;
    test.by_few_samples = false;
    const auto x = static_cast<int>(pixel % width), y = static_cast<int>(pixel / width);
    test.sentence =
        fmt::format("pixel ({}, {}) of {} is {:.2g} and holds more than {:.0g} times all light of the other", x, y,
                    picture.engine, mean.rgb[i], times);
    test.tiles = {{x, y, 1, 1, kNoDeviation, test.sentence}};
    return;
  }
}

std::array<double, 3> light_of(const EnginePicture& picture) {
  std::array<double, 3> light{};
  for (std::size_t i = 0; i < picture.rendering.mean.rgb.size(); ++i)
    light[i % 3] += double{picture.rendering.mean.rgb[i]};
  return light;
}

/// What the brightest sample of a picture adds to its pixel. Variances of few batches are a block's (studio.cpp), which
/// a dark pixel of it cannot owe to one sample: so no more than their root.
double brightest_sample(const EnginePicture& picture) {
  double most = 0;
  for (std::size_t i = 0; i < picture.rendering.mean.rgb.size(); ++i) {
    const double variance = variance_of(picture, i);
    if (variance > 0)
      most = std::max(most, variance / std::max(double{picture.rendering.mean.rgb[i]}, std::sqrt(variance)));
  }
  return most;
}

/// The second with the variance that light in such samples has, where what differs would be made of them: of the
/// whole image, of its blocks, and of single pixels that are far off.
EnginePicture widened_by_few_samples(const EnginePicture& first, const EnginePicture& second) {
  const double sample = std::max(brightest_sample(first), brightest_sample(second));
  const Deviations d = deviations_between(first, second);
  const double pixels = static_cast<double>(d.width) * d.height;
  const double far_off = -boost::math::quantile(boost::math::normal(), sidak(pair_alpha, 3 * pixels) / 2);
  EnginePicture widened = second;
  Image& variance = *widened.rendering.variance;
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t b = 0; b < d.places.size(); ++b) {
      const double of_all = std::max(std::abs(d.whole[c].difference) / pixels,
                                     std::abs(d.blocks[c][b].difference) / d.places[b].pixels());
      for_each_pixel(d.places[b], [&](int x, int y) {
        const Deviation& pixel = pixel_of(d, x, y, c);
        const double off = std::abs(pixel.difference);
        const double light = off > far_off * pixel.standard_error ? std::max(off, of_all) : of_all;
        float& known = variance.pixel(x, y)[c];
        known = std::max(known, static_cast<float>(sample * light));
      });
    }
  return widened;
}

}  // namespace

PairTest test_pair(const EnginePicture& first, const EnginePicture& second, double alpha) {
  PairTest test = test_by_known_noise(first, second, alpha);
  if (test.differs) {
    const PairTest widened = test_by_known_noise(first, widened_by_few_samples(first, second), alpha);
    if (!widened.differs) {
      const std::string sentence = test.sentence + ": by less light than some twenty of its brightest samples carry";
      test = widened;
      test.by_few_samples = true;
      test.sentence = sentence;
    }
  }
  find_outlier(first, light_of(second), alpha, test);
  find_outlier(second, light_of(first), alpha, test);
  test.relmse = relmse_of(first.rendering.mean, second.rendering.mean);
  test.ssim = ssim_of(first.rendering.mean, second.rendering.mean);
  return test;
}

PairTest test_against_closed_form(const RgbD& mean, const EnginePicture& picture) {
  constexpr double digits_stated = 1e-5;
  Deviations d = deviations_between(without_noise(picture), picture);
  const double stated[] = {mean.x, mean.y, mean.z};
  PairTest test;
  DeclaredError declared = picture.declared;
  declared.whole += digits_stated;
  for (std::size_t c = 0; c < 3; ++c) {
    Deviation& whole = d.whole[c];
    const double shown = whole.expected;
    whole.expected = stated[c] * static_cast<double>(picture.rendering.mean.pixels());
    whole.difference = shown - whole.expected;
  }
  compare_channels(d, declared, test);
  test.differs = test.whole_differs;
  if (test.differs) test.sentence = whole_sentence(d, test.channels);
  test.whole_shift = relative_shift(whole_of(d, test.channels));
  find_outlier(picture, {d.whole[0].expected, d.whole[1].expected, d.whole[2].expected}, pair_alpha, test);
  return test;
}

std::optional<double> would_see_alone(const EnginePicture& picture) {
  const Deviations d = deviations_between(without_noise(picture), picture);
  std::optional<double> seen;
  for (const Deviation& whole : d.whole)
    if (whole.expected != 0) seen = std::max(seen.value_or(0), least_shift(whole, 0));
  return seen;
}

}  // namespace photonproof
