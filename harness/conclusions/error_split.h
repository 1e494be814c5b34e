// Error of a few images of one budget, split into what averages out over seeds and what does not: relmse, variance and
// squared bias, each relative as relmse is.
#pragma once

#include <optional>
#include <span>

#include "reports/record/results.h"
#include "scenes/images/image.h"

namespace photonproof::inline harness_conclusions {

struct ErrorSplit {
  Estimate relmse;                   ///< mean over the images; an interval from two images on
  std::optional<Estimate> bias2;     ///< from two images on
  std::optional<Estimate> variance;  ///< of one image; from two images on
  /// The largest share of the squared error that one pixel has. Beyond `most_of_a_pixel` the error's distribution over
  /// seeds is that of few pixels' rare bright samples: these images may have met none, and nothing has an interval.
  double share_of_a_pixel = 0;
  static constexpr double most_of_a_pixel = 0.05;
  bool is_of_few_pixels() const { return share_of_a_pixel > most_of_a_pixel; }
};

/// With images x_k, reference r and weights w = 1/(r^2 + 0.01), means over all channel values:
///   relmse    mean w (x_k - r)^2, over k as well
///   variance  mean w s^2, s^2 the sample variance over k
///   bias2     mean w ((m - r)^2 - s^2/K - v), m the mean image, v the reference's variance of the mean
/// bias2 is unbiased, so that it is as often negative as positive where there is no bias.
///
/// Intervals. That of relmse comes from the spread over images, block by block (normal) or as a whole (Student's t),
/// whichever is wider: noise that pixels share beyond a block is only seen by the latter. Those of bias2 and variance
/// resample blocks of pixels (BCa) where three images or more show no noise that blocks share. Else the images alone
/// are independent, and the distance of m from the expectation is at most
///   h = sqrt(t^2 variance/K + v),   t Student's quantile of K - 1 degrees of freedom,
/// with 95 % probability if all pixels vary as one, and more often otherwise. So the root of the squared bias is within
/// h of the root of mean w (m - r)^2. The variance then is known as one of K - 1 degrees of freedom is, by chi^2; two
/// images give no useful interval of it.
/// `reference_variance` may be null: then v = 0. Where v is only known not to be too small (a render estimates it as if
/// its samples were independent, and those of a Sobol sequence do better), bias2's interval reaches up to where it
/// would with v = 0. Precondition: images and reference have one size and are finite; there is at least one image.
enum class ReferenceVariance { exact, upper_bound };
ErrorSplit split_error(const Image& reference, const Image* reference_variance, std::span<const Image> images,
                       ReferenceVariance known = ReferenceVariance::exact);

/// Mean of w v: what the reference's own noise adds to every relmse.
double relative_variance(const Image& reference, const Image& reference_variance);

}  // namespace photonproof::inline harness_conclusions
