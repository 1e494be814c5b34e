#include "harness/stress/level_judge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "harness/pixels/image_blocks.h"
#include "harness/statistics/agreement.h"
#include "scenes/images/mean_error.h"

namespace photonproof::inline harness_stress {
namespace {

std::size_t non_finite_pixel_values(const Image& image) {
  return static_cast<std::size_t>(
      std::count_if(image.rgb.begin(), image.rgb.end(), [](float v) { return !std::isfinite(v); }));
}

/// Divided by the factor, so that both sides are of ordinary size.
Image divided(const Image& image, double factor) {
  Image out = image;
  for (float& v : out.rgb) v = static_cast<float>(double{v} / factor);
  return out;
}

bool any_other_than_zero(const Image& image) {
  return std::any_of(image.rgb.begin(), image.rgb.end(), [](float v) { return v != 0; });
}

/// Whether no value is the largest float, which stands for overflow, and the largest one is a normal number. (The
/// program must warn of smaller ones.)
bool is_in_range(const Image& variance) {
  const float largest = *std::max_element(variance.rgb.begin(), variance.rgb.end());
  return largest < std::numeric_limits<float>::max() && largest >= std::numeric_limits<float>::min();
}

double mean_of(const Image& image) {
  double sum = 0;
  for (const float v : image.rgb) sum += double{v};
  return image.rgb.empty() ? 0 : sum / static_cast<double>(image.rgb.size());
}

/// The expected image and its variance.
Rendering expected_rendering(const LevelExpectation& expected, const Image& like) {
  if (expected.picture) return *expected.picture;
  Rendering flat;
  flat.mean = flat.variance.emplace(like.width, like.height);
  std::fill(flat.mean.rgb.begin(), flat.mean.rgb.end(), static_cast<float>(*expected.radiance));
  return flat;
}

/// The reference's share of the sum of both variances, averaged over pixels so that a few bright ones do not dominate.
double share_of_variance(const Rendering& reference, const Rendering& test) {
  double shares = 0, values = 0;
  for (std::size_t i = 0; i < reference.variance->rgb.size(); ++i) {
    const double of_reference = double{reference.variance->rgb[i]};
    const double of_both = of_reference + double{test.variance->rgb[i]};
    if (of_both <= 0) continue;
    shares += of_reference / of_both;
    ++values;
  }
  return values > 0 ? shares / values : 0;
}

/// The stated error of the whole image's mean. Pixels that gather the same photons err together.
struct CommonError {
  double deviation = 0, share_of_expected = 0;  ///< `share_of_expected`: the expected picture's share of the square.
};

CommonError common_error(const Rendering& reference, const Rendering& test) {
  CommonError largest;
  const std::optional<MeanError> a = stored_mean_error(reference), b = stored_mean_error(test);
  for (std::size_t c = 0; c < 3; ++c) {
    const double of_reference = a ? a->standard_error[c] : 0;
    const double deviation = std::hypot(of_reference, b ? b->standard_error[c] : 0);
    if (deviation > largest.deviation) largest = {deviation, std::pow(of_reference / deviation, 2)};
  }
  return largest;
}

struct BlockSums {
  Block block;
  double difference = 0, expected = 0, variance = 0;  ///< Sums over all pixels and channels.
};

std::vector<BlockSums> sums_of_blocks(const Rendering& reference, const Rendering& test) {
  std::vector<BlockSums> blocks;
  for (const Block& block : blocks_of(test.mean.width, test.mean.height)) {
    BlockSums& sums = blocks.emplace_back(BlockSums{block});
    for_each_pixel(block, [&](int x, int y) {
      for (int c = 0; c < 3; ++c) {
        sums.difference += double{test.mean.pixel(x, y)[c]} - double{reference.mean.pixel(x, y)[c]};
        sums.expected += double{reference.mean.pixel(x, y)[c]};
        // Channels of a sample vary together.
        sums.variance += 3 * (double{test.variance->pixel(x, y)[c]} + double{reference.variance->pixel(x, y)[c]});
      }
    });
  }
  return blocks;
}

/// The factor by which blocks deviate more than blocks of independent pixels. Where pixels are small against the gather
/// discs of photons, neighbours err together. It uses the median block, so that a wrong part does not count. It is 1
/// for few blocks.
double errors_in_common(const std::vector<BlockSums>& blocks) {
  constexpr std::size_t tell = 100;
  constexpr double median_of_normal = 0.6745;  // median of |x|
  std::vector<double> deviations;
  for (const BlockSums& sums : blocks)
    if (sums.variance > 0) deviations.push_back(std::abs(sums.difference) / std::sqrt(sums.variance));
  if (deviations.size() < tell) return 1;
  const auto middle = deviations.begin() + static_cast<std::ptrdiff_t>(deviations.size() / 2);
  std::nth_element(deviations.begin(), middle, deviations.end());
  return std::max(1.0, *middle / median_of_normal);
}

/// Judges the means of blocks and of the whole against a band about the expected ones, which noise widens.
LevelVerdict judge_means(const Rendering& reference, const Rendering& test, double claimed_bias) {
  const CommonError together = common_error(reference, test);
  const double sigmas = 4.5, common = 3 * together.deviation;
  LevelVerdict verdict;
  verdict.outcome = LevelOutcome::right;
  const std::vector<BlockSums> blocks = sums_of_blocks(reference, test);
  const double wider = errors_in_common(blocks);
  double worst = 0, all_difference = 0, all_expected = 0, all_variance = 0;
  for (const BlockSums& sums : blocks) {
    all_difference += sums.difference;
    all_expected += sums.expected;
    all_variance += sums.variance;
    const double pixels = sums.block.pixels();  // if all err as one, the block errs by the root of their number
    const double deviation = std::max(std::min(wider, std::sqrt(pixels)) * std::sqrt(sums.variance), common * pixels);
    const double band = (biased_block + 4 * claimed_bias) * std::abs(sums.expected) + 2 * sigmas * deviation;
    const double beyond = std::abs(sums.difference) / std::max(band, 1e-300);
    if (std::abs(sums.difference) <= band || beyond <= worst) continue;
    worst = beyond;
    verdict.outcome = LevelOutcome::silently_wrong;
    verdict.sentence = fmt::format("the block at ({}, {}) is off by {:+.3g} % of {:.4g}", sums.block.x0, sums.block.y0,
                                   100 * sums.difference / sums.expected, sums.expected / pixels / 3);
  }
  const double by_themselves = std::sqrt(all_variance), as_one = common * test.mean.width * test.mean.height;
  const double noise = sigmas * std::max(by_themselves, as_one);
  verdict.share_of_expected = as_one > by_themselves ? together.share_of_expected : share_of_variance(reference, test);
  verdict.allowed = biased_mean + 4 * claimed_bias;
  const double band = verdict.allowed * std::abs(all_expected) + noise;
  if (std::abs(all_difference) > band) {
    verdict.outcome = LevelOutcome::silently_wrong;
    verdict.sentence = fmt::format("the mean is off by {:+.3g} %", 100 * all_difference / all_expected);
  }
  if (all_expected != 0) verdict.would_see = verdict.allowed + 2 * noise / std::abs(all_expected);
  return verdict;
}

LevelVerdict judge_pixels(const Rendering& reference, const Rendering& test) {
  const Agreement agreement = test_agreement(reference, test, level_alpha);
  LevelVerdict verdict;
  verdict.would_see = agreement.would_see;
  if (verdict.would_see && !std::isfinite(*verdict.would_see)) verdict.would_see = 1e9;
  verdict.share_of_expected = share_of_variance(reference, test);
  verdict.outcome = agreement.pass() ? LevelOutcome::right : LevelOutcome::silently_wrong;
  if (!agreement.whole.pass)
    verdict.sentence = agreement.whole.sentence;
  else if (!agreement.blocks.pass)
    verdict.sentence = agreement.blocks.sentence;
  else if (!agreement.pixels.pass)
    verdict.sentence = agreement.pixels.sentence;
  return verdict;
}

/// Judges an existing picture. The result is silently_wrong where it is not the expected one, whatever warnings there
/// are.
LevelVerdict judge_picture(const LevelEvidence& evidence, const LevelExpectation& expected) {
  LevelVerdict verdict;
  const Rendering& picture = *evidence.picture;
  if (const std::size_t broken = non_finite_pixel_values(picture.mean); broken > 0) {
    verdict.outcome = LevelOutcome::silently_wrong;
    verdict.sentence = fmt::format("{} of {} values are not finite", broken, picture.mean.rgb.size());
    return verdict;
  }
  verdict.outcome = LevelOutcome::right;
  if (!expected.picture && !expected.radiance) return verdict;
  Rendering test;
  test.mean = divided(picture.mean, expected.factor);
  if (std::optional<MeanError> error = stored_mean_error(picture)) {
    for (double& deviation : error->standard_error) deviation /= expected.factor;
    store_mean_error(test, *error);
  }
  Rendering reference = expected_rendering(expected, test.mean);
  if (!reference.variance) reference.variance.emplace(test.mean.width, test.mean.height);
  const bool has_noise = picture.variance && any_other_than_zero(*picture.variance);
  const bool is_known = has_noise && is_in_range(*picture.variance);
  if (is_known) {
    test.variance = divided(divided(*picture.variance, expected.factor), expected.factor);
  } else {
    test.variance = *reference.variance;  // scaled from the reference's number of samples
    for (float& v : test.variance->rgb) v *= static_cast<float>(expected.samples / evidence.samples);
  }
  if (!any_other_than_zero(reference.mean) && mean_of(test.mean) != 0) {
    verdict.outcome = LevelOutcome::silently_wrong;
    verdict.sentence = fmt::format("light of {:.3g} where none is expected", mean_of(test.mean));
    return verdict;
  }
  const bool by_pixels = expected.is_exact && is_known;
  verdict = by_pixels ? judge_pixels(reference, test) : judge_means(reference, test, 0);
  // The bias that an engine states excuses a wrong picture; a right one needs no excuse.
  if (!by_pixels && verdict.outcome != LevelOutcome::right)
    verdict = judge_means(reference, test, evidence.relative_bias);
  const bool is_lost = evidence.states_noise && !is_known && any_other_than_zero(*reference.variance);
  if (verdict.outcome == LevelOutcome::right && is_lost && evidence.losses.empty()) {
    verdict.outcome = LevelOutcome::silently_wrong;
    verdict.sentence =
        has_noise ? "the mean is right, but its variance is out of range" : "the mean is right, but its variance is 0";
  }
  return verdict;
}

}  // namespace

LevelVerdict judge_level(const LevelEvidence& evidence, const LevelExpectation& expected) {
  const bool is_reported = !evidence.losses.empty();
  if (evidence.refused) return {LevelOutcome::refused, evidence.message, {}};
  if (!evidence.picture) return {LevelOutcome::crashed, evidence.ending + ": " + evidence.message, {}};
  if (expected.must_refuse && !is_reported)
    return {LevelOutcome::silently_wrong, "was rendered, though an input is not a number", {}};
  LevelVerdict verdict = judge_picture(evidence, expected);
  verdict.is_wrong = verdict.outcome == LevelOutcome::silently_wrong;
  if (verdict.is_wrong && is_reported) {
    verdict.outcome = LevelOutcome::degraded;
    verdict.sentence += "; said: " + evidence.losses.front();
  } else if (verdict.outcome == LevelOutcome::right) {
    if (verdict.would_see && *verdict.would_see > level_power) {
      verdict.outcome = is_reported ? LevelOutcome::degraded : LevelOutcome::undecided;
      verdict.sentence = fmt::format("the minimum detectable error is {:.3g} %{}", 100 * *verdict.would_see,
                                     is_reported ? "; said: " + evidence.losses.front() : "");
    } else if (is_reported) {
      verdict.sentence = "right, and reported: " + evidence.losses.front();
    }
  }
  return verdict;
}

}  // namespace photonproof::inline harness_stress
