// Splits the error of a few images of one budget into relmse, variance and squared bias. Variance averages out over
// seeds, bias does not. Each is relative as relmse is.
#pragma once

#include <optional>
#include <span>

#include "reports/record/results.h"
#include "scenes/images/image.h"

namespace photonproof::inline harness_conclusions {

struct ErrorSplit {
  Estimate relmse;                   ///< mean over the images; an interval from two images on
  std::optional<Estimate> bias2;     ///< from two images on
  std::optional<Estimate> variance;  ///< of one image; needs two images
  /// Largest share of the squared error in a single pixel. Above `most_of_a_pixel` the error depends on the rare bright
  /// samples of a few pixels, which these images may have missed, so nothing gets an interval.
  double share_of_a_pixel = 0;
  static constexpr double most_of_a_pixel = 0.05;
  bool is_of_few_pixels() const { return share_of_a_pixel > most_of_a_pixel; }
};

/// With images x_k, reference r and weights w = 1/(r^2 + 0.01), the means over all channel values are:
///   relmse    mean w (x_k - r)^2, over k as well
///   variance  mean w s^2, s^2 the sample variance over k
///   bias2     mean w ((m - r)^2 - s^2/K - v), m the mean image, v the reference's variance of the mean
/// `bias2` is unbiased, so without a bias it is negative as often as positive.
///
/// Intervals. That of relmse comes from the spread over images: by blocks (normal) or by whole images (Student's t),
/// whichever is wider. Only the latter shows noise that pixels share beyond a block. Those of bias2 and variance
/// resample blocks of pixels (BCa) if three images or more show no noise that blocks share. Else only the images are
/// independent, and the distance of m from the expectation is at most
///   h = sqrt(t^2 variance/K + v),   t Student's quantile of K - 1 degrees of freedom,
/// with 95 % probability if all pixels vary as one, and more often otherwise. So the root of the squared bias is within
/// h of the root of mean w (m - r)^2. The variance then has a chi^2 interval of K - 1 degrees of freedom; two images
/// give no useful one. `reference_variance` may be null: then v = 0. With `upper_bound`, v may be too large: a render
/// estimates it as if its samples were independent, but those of a Sobol sequence do better. Then bias2's interval
/// extends to the upper end for v = 0. Precondition: at least one image; images and reference have one size and are
/// finite.
enum class ReferenceVariance { exact, upper_bound };
ErrorSplit split_error(const Image& reference, const Image* reference_variance, std::span<const Image> images,
                       ReferenceVariance known = ReferenceVariance::exact);

/// Mean of w v: the contribution of the reference's own noise to every relmse.
double relative_variance(const Image& reference, const Image& reference_variance);

}  // namespace photonproof::inline harness_conclusions
