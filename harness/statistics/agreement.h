// Tests whether two renderings have the same expected image. Gate suites call this `agreement`. It tests every
// pixel's difference against its noise, and the differences of block means, which also show a small wide bias. It tests
// the means of the whole images, too: their power is known, so a pass states the minimum detectable error.
//
// Both sides need variance layers. Those assume independent estimates in a pixel, so render with `--sampler
// independent`. With Sobol samples they overstate the variance: the test then passes too easily and never fails
// wrongly.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "scenes/images/image.h"

namespace photonproof::inline harness_statistics {

struct StatisticalVerdict {
  bool pass = true;
  double observed = 0;   ///< The statistic.
  double bound = 0;      ///< The largest value that passes.
  std::size_t n = 0;     ///< The number of values, or of blocks a channel, that were tested.
  double alpha = 0;      ///< The level of one of the tests, corrected for their number.
  std::string sentence;  ///< The worst place: "pixel (3, 4) R is 0.5, reference 0.25: 6.1 deviations".
};

struct Agreement {
  /// The largest |difference| in standard deviations over pixels and channels, against the two-sided normal quantile at
  /// Sidak's level 1 - (1 - alpha)^(1/n).
  StatisticalVerdict pixels;
  /// The largest chi^2 of a channel over blocks of 8 x 8 pixels, at Sidak's level for three channels (which need not be
  /// independent: Sidak 1967).
  StatisticalVerdict blocks;
  /// The largest difference of a channel's weighed mean over the whole image, in standard errors as a normal deviate,
  /// at Sidak's level for three channels.
  StatisticalVerdict whole;
  /// The minimum detectable relative error of one channel's mean, in either direction: `whole` alone finds it with
  /// probability `power`. For 1.2 % this is 0.012. The largest of the channels that are not black; empty where all are
  /// black, infinite where noise hides any error.
  std::optional<double> would_see;
  static constexpr double power = 0.99;
  /// Pixels of an image share noise. Blocks were not judged, and the whole image only if it states the error of its
  /// mean. Verdicts that were not judged are a pass whose sentence says so.
  bool shared_noise = false;
  /// True if neither blocks nor the whole image could be judged, and no single pixel differs.
  bool inconclusive = false;
  bool pass() const { return pixels.pass && blocks.pass && whole.pass; }
  /// "an error of 1.2 % of the whole image would have been seen (probability 0.99)", printed beside a pass.
  std::string power_sentence() const;
};

/// The test fails with probability `alpha` where the expected images are equal; each of its three parts has Sidak's
/// level for three. Estimated variances need more than the formulas:
/// * A pixel that met no rare bright sample looks dark and certain. Its variance is therefore at least the mean
///   variance of its block. Where whole blocks miss such samples (fewer than about 20 a block), the test may fail
///   wrongly.
/// * The mean of a few skewed samples is skewed, and its tail is longer than the normal one. The variances of similar
///   pixels differ by (k - 1)/K relative for kurtosis k and K estimates. The tail is that of the Gamma distribution
///   with this excess kurtosis, 6 / shape. Normal samples count as slightly skewed by this.
/// * A block's variance that rests on few bright pixels is uncertain. Its deviation is Student's t, turned into the
///   normal deviate of the same probability. The spread of the variances over the block gives the degrees of freedom,
///   at least 2 (sum v)^2 / sum (v - mean v)^2.
/// * Rounding of float sums counts as a deviation of 1e-5 of the value, so that pixels without noise compare as equal.
/// * The mean over the whole image gives less certain places less weight, at most four times the median place's weight.
///   In many images a few pixels at a light's edge have nearly all of the noise. A pixel's weight comes from neighbours
///   whose noise it does not share: its own variance would give samples that are high by chance too little weight.
/// * Neighbours that a splat of a light path spans vary together. A block's variance is multiplied by the number that
///   the image states (scenes/images/mean_error.h).
/// * The variance of the whole image's mean is its pixels', unless the image states that pixels vary together
///   (scenes/images/mean_error.h). Blocks are then compared without the deviation that all pixels have in common.
///
/// The test holds its level from 64 estimates a pixel on, from 16 on where samples are no wilder than exponential
/// (agreement_test.cpp measures it). The image (mean_error.h) or the caller may state that pixels gather the same
/// photons. Blocks then vary by more than their pixels' variances, by an unknown factor, and are not judged. Pixels are
/// judged, as Sidak's level also holds for dependent values, by Student's t of the stated number of passes. The whole
/// image is judged by its plain mean if the image states the mean's error; else the verdict is inconclusive.
/// Preconditions: equal sizes, finite values. Throws InputError, naming `reference` or `test`, without a variance.
Agreement test_agreement(const Rendering& reference, const Rendering& test, double alpha = 0.01,
                         bool shared_noise = false);

}  // namespace photonproof::inline harness_statistics
