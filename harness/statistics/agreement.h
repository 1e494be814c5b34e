// Do two renderings show the same expected image? The test METRICS calls `agreement`: every pixel's difference against
// its noise, the differences of block means, so that a small wide bias shows, too, and the means of the whole images,
// whose power is known: a pass says how large an error it would not have passed over.
//
// Both sides need variance layers. Those take the estimates of a pixel for independent, so render with `--sampler
// independent`: of Sobol samples they say too much, and the test then passes too easily, never fails wrongly.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "scenes/images/image.h"

namespace photonproof::inline harness_statistics {

struct StatisticalVerdict {
  bool pass = true;
  double observed = 0;   ///< the statistic
  double bound = 0;      ///< what it must not exceed
  std::size_t n = 0;     ///< values, or blocks a channel, that were tested
  double alpha = 0;      ///< of one of the tests, corrected for their number
  std::string sentence;  ///< where and how it is worst: "pixel (3, 4) R is 0.5, reference 0.25: 6.1 deviations"
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
  /// The least relative error of one channel of the whole image, in either direction, that `whole` alone finds with
  /// probability `power`: where 1.2 % would have been seen, this is 0.012. The largest of the channels that are not
  /// black; empty where all are, infinite where noise hides any error.
  std::optional<double> would_see;
  static constexpr double power = 0.99;
  /// Pixels of an image share noise: blocks were not judged, and the whole image only if it says how certain its mean
  /// is. Their verdicts then are a pass whose sentence says so.
  bool shared_noise = false;
  /// Neither blocks nor the whole image could be judged, and no single pixel differs.
  bool inconclusive = false;
  bool pass() const { return pixels.pass && blocks.pass && whole.pass; }
  /// "an error of 1.2 % of the whole image would have been seen (probability 0.99)", to be said beside a pass.
  std::string power_sentence() const;
};

/// One of the three tests, each at Sidak's level for three, fails with probability `alpha` where the expected images
/// are equal. What an estimated variance needs beside the formulas:
/// - A pixel that saw none of its rare bright samples looks dark and certain. Its variance therefore is at least the
///   mean one of its block, which saw some. Where an image's blocks miss them, too (fewer than about 20 such samples a
///   block), no test of variances can know, and it may fail wrongly.
/// - The mean of a few skewed samples is skewed, and its far tail is not normal's. The samples' kurtosis k shows in how
///   the variances of alike pixels differ, by (k - 1)/K relative for K estimates; the tail is taken as that of the
///   Gamma distribution with this excess kurtosis, 6 / shape. Normal samples count as a little skewed by this.
/// - A block's variance that rests on few bright pixels is uncertain; its deviation is taken as Student's t with the
///   degrees of freedom that the spread of the variances over the block shows, 2 (sum v)^2 / sum (v - mean v)^2 at
///   least, and turned into the normal deviate of the same probability.
/// - Rounding of float sums counts as a deviation of 1e-5 of the value, so that pixels without noise compare as equal.
/// - In the mean over the whole image the less certain places count less, for in many an image a few pixels at a
/// light's
///   edge have nearly all of the noise, and none counts more than four times as much as the median one. A pixel's
///   weight is taken from neighbours whose noise it does not share: weighed by their own variances, samples that are
///   high by chance would count too little.
/// - Neighbours that a splat of a light path spans vary together: a block's variance is so many times its pixels' as
///   the image says (scenes/images/mean_error.h).
/// - That mean's variance is its pixels', unless the image says that they vary together (scenes/images/mean_error.h).
///   Blocks are then compared without what all pixels are high or low by together.
/// It holds its level from 64 estimates a pixel on, from 16 on where samples are no wilder than exponential
/// (agreement_test.cpp measures it).
/// Where pixels look up the same photons, as an image says (mean_error.h) or the caller knows, blocks vary by more than
/// their pixels' variances, and by how much is not known: they are not judged. Pixels are, for Sidak's level also holds
/// for values that vary together, by Student's t of as many passes as the images say; and the plain mean of the whole
/// image, whose error the image says. Without that the verdict is inconclusive.
/// Preconditions: equal sizes, finite values. Throws InputError, naming `reference` or `test`, when one has no
/// variance.
Agreement test_agreement(const Rendering& reference, const Rendering& test, double alpha = 0.01,
                         bool shared_noise = false);

}  // namespace photonproof::inline harness_statistics
