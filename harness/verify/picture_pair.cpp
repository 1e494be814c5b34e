#include "harness/verify/picture_pair.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "harness/metrics/metrics.h"
#include "harness/statistics/picture_noise.h"

namespace photonproof::inline harness_verify {
namespace {

/// Stands for an unknown value: no known one is less certain.
constexpr double kNoDeviation = 1e9;

/// A pair is never too noisy to agree, since `would_see` gives the detectable error.
constexpr AgreementBounds no_bounds{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};

bool any_of(const std::array<bool, 3>& channels) { return channels[0] || channels[1] || channels[2]; }

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

/// Sum over the given channels, or over all if none is given.
Deviation whole_of(const Deviations& d, const std::array<bool, 3>& channels) {
  const bool any = any_of(channels);
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

/// Sets the shifts of the means, and the minimum detectable error.
void compare_channels(const Deviations& d, double alpha, const AllowedError& allowed, PairTest& test) {
  for (std::size_t c = 0; c < 3; ++c)
    if (d.whole[c].expected != 0) test.shift[c] = d.whole[c].difference / std::abs(d.whole[c].expected);
  const Judgement judgement = judge_whole(judged_means(d, allowed), alpha, allowed);
  test.would_see = judgement.would_see;
  test.channels = judgement.whole_off;
  test.whole_differs = any_of(judgement.whole_off);
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

/// Sum of a channel over a tile.
double light_in(const Image& image, const FailingTile& tile, std::size_t c) {
  double sum = 0;
  for (int y = tile.y; y < tile.y + tile.height; ++y)
    for (int x = tile.x; x < tile.x + tile.width; ++x) sum += double{image.pixel(x, y)[c]};
  return sum;
}

}  // namespace

Deviations deviations_between(const EnginePicture& first, const EnginePicture& second) {
  return deviations_between(NoisyPicture{first.rendering, first.images}, {second.rendering, second.images});
}

AllowedError both_declare(const EnginePicture& first, const EnginePicture& second) {
  return {first.declared.whole + second.declared.whole, first.declared.block + second.declared.block};
}

namespace {

/// The reason why this picture's noise is unknown; empty if it is known.
std::string why_noise_is_unknown(const EnginePicture& picture) {
  if (picture.images.empty() || picture.images.size() >= std::size_t{least_images}) return {};
  return fmt::format("{} has no variance, and fewer than {} images do not show its noise", picture.engine,
                     least_images);
}

void judge(const EnginePicture& first, const EnginePicture& second, double alpha, PairTest& test) {
  const AllowedError allowed = both_declare(first, second);
  const Deviations d = deviations_between(first, second);
  compare_channels(d, alpha, allowed, test);
  const Judgement judgement = judge_agreement(d, no_bounds, alpha, allowed);
  test.differs = judgement.verdict == GateVerdict::fail;
  test.tiles = judgement.tiles;
  if (test.differs) {
    test.sentence = judgement.sentence;
    for (std::size_t c = 0; c < 3; ++c) test.channels[c] = test.channels[c] || judgement.blocks_off[c];
  } else if (!judgement.but_for_rare_samples.empty()) {
    test.is_undecided = true;
    test.sentence = "too few samples to meet rare bright ones: " + judgement.but_for_rare_samples;
  }
  name_places(d, test);
  test.whole_shift = relative_shift(whole_of(d, test.channels));
}

/// Marks the pixel of this picture with more light than chance allows beside `other`, with its light in each channel.
void find_outlier(const EnginePicture& picture, const std::array<double, 3>& light, double alpha, PairTest& test) {
  const Image& mean = picture.rendering.mean;
  for (std::size_t i = 0; i < mean.rgb.size(); ++i) {
    const std::size_t c = i % 3, pixel = i / 3, width = static_cast<std::size_t>(mean.width);
    const double times = 6 / alpha;
    if (!(light[c] > 0) || double{mean.rgb[i]} <= times * light[c]) continue;
    test.differs = test.has_outlier = test.channels[c] = true;
    test.is_undecided = false;
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

}  // namespace

PairTest test_pair(const EnginePicture& first, const EnginePicture& second, double alpha) {
  PairTest test;
  for (const EnginePicture* picture : {&first, &second})
    if (test.sentence.empty()) test.sentence = why_noise_is_unknown(*picture);
  test.is_undecided = !test.sentence.empty();
  if (!test.is_undecided) judge(first, second, alpha, test);
  find_outlier(first, light_of(second), alpha, test);
  find_outlier(second, light_of(first), alpha, test);
  test.relmse = relmse_of(first.rendering.mean, second.rendering.mean);
  test.ssim = ssim_of(first.rendering.mean, second.rendering.mean);
  return test;
}

PairTest test_against_closed_form(const RgbD& mean, const EnginePicture& picture) {
  constexpr double digits_stated = 1e-5;
  Deviations d = noise_of({picture.rendering, picture.images});
  const double stated[] = {mean.x, mean.y, mean.z};
  const auto pixels = static_cast<double>(picture.rendering.mean.pixels());
  PairTest test;
  for (std::size_t c = 0; c < 3; ++c) {
    Deviation& whole = d.whole[c];
    whole.difference = whole.expected - stated[c];
    whole.expected = stated[c];
  }
  test.sentence = why_noise_is_unknown(picture);
  test.is_undecided = !test.sentence.empty();
  if (!test.is_undecided) compare_channels(d, pair_alpha, {picture.declared.whole + digits_stated}, test);
  test.differs = test.whole_differs;
  if (test.differs) test.sentence = whole_sentence(d, test.channels);
  test.whole_shift = relative_shift(whole_of(d, test.channels));
  find_outlier(picture, {pixels * stated[0], pixels * stated[1], pixels * stated[2]}, pair_alpha, test);
  return test;
}

std::optional<double> would_see_alone(const EnginePicture& picture) {
  return judge_whole(noise_of({picture.rendering, picture.images}).whole, pair_alpha).would_see;
}

double largest_difference(const PairTest& test, const EnginePicture& first, const EnginePicture& second) {
  double largest = 0;
  for (const double shift : test.shift) largest = std::max(largest, std::abs(shift));
  for (const FailingTile& tile : test.tiles)
    for (std::size_t c = 0; c < 3; ++c)
      if (const double expected = light_in(first.rendering.mean, tile, c); expected > 0)
        largest = std::max(largest, std::abs(light_in(second.rendering.mean, tile, c) / expected - 1));
  return largest;
}

}  // namespace photonproof::inline harness_verify
