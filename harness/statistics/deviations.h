// Independent images of one expectation against a reference. Measures the deviation of their mean, and the part of it
// that chance explains, by pixel, by block of 8 x 8 pixels and overall. All statistics of gates rest on these.
//
// The differences between the images alone measure the noise; nothing that the engine states counts. Few images give a
// poor estimate of one pixel's variance, so its neighbours steady it (student.h, freedom_of_expectation).
// * The expected variance of a pixel is its block's mean. A block's is that of independent pixels, times the mean
//   factor by which blocks exceed it (light tracers and photon maps correlate pixels). The worth of these expectations
//   is measured, too, for a block or a channel at a time.
// * The remaining uncertainty is in the degrees of freedom of Student's t.
// * A pixel's mean of a few skewed images is skewed, and its upper tail longer than the normal one. It is taken as the
//   tail of the Gamma distribution with the skewness that the block's pixels show together.
// * Where pixels or blocks share noise, all may look steady and be wrong together. An expectation is worth no more than
//   the independent ones among them (shared_noise.h).
// * Rare bright samples that some images met show what others may have missed (deviation.h). A block's third moment
//   over its second is the amount that one sample adds to a pixel. It is f for a Poisson number of samples of f each,
//   and about 0 for normal noise. Any block may miss the brightest sample of any other, at most in proportion to its
//   brightness.
// * The whole image's variance has no neighbours: its degrees of freedom come from the number of images.
// * A committed reference is rounded to half floats at random (reference/store/half_rounding.h), and its variance
//   includes that. A value rounded up once in a thousand is not normal, though. So each pixel of the reference is taken
//   to be as uncertain as that rounding can make it, 2^-11 of its value.
// * Rounding of sums counts as a deviation of 1e-5 of the value, so that pixels without noise compare as equal.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "harness/pixels/image_blocks.h"
#include "harness/statistics/deviation.h"
#include "scenes/images/image.h"

namespace photonproof::inline harness_statistics {

struct Deviations {
  int width = 0, height = 0;
  std::size_t images = 0;
  std::vector<Block> places;                     ///< Places of the blocks.
  std::array<std::vector<Deviation>, 3> pixels;  ///< Row-major, by channel.
  std::array<std::vector<Deviation>, 3> blocks;  ///< In the order of `places`.
  std::array<Deviation, 3> whole;
  /// Means in which certain places count more (weighed_mean.h). Known where two pictures have variance layers.
  std::optional<std::array<Deviation, 3>> weighed{};
  std::array<double, 3> independent_blocks{};  ///< Number of independent blocks with equal noise, by channel.
};

/// Noise that is known besides the differences of the images.
struct KnownNoise {
  double reference_freedom = 1;  ///< Degrees of freedom of the reference's variance.
  /// The least variance of each pixel of one image. It helps where images are too few to have met rare bright samples
  /// that the reference has met. If half of the images meet a light smaller than a pixel, then in one gate of 256 none
  /// of eight images meets it.
  const Image* least_variance = nullptr;
  /// Samples a pixel of one image. In nearly every image, stratified samples fall on the two sides of an edge in the
  /// same numbers, which differ from the expected ones. So a single pixel may be off by one sample of the contrast
  /// around it.
  std::optional<double> samples{};
};

/// Preconditions: at least two images; equal sizes, finite values, a reference with variance.
Deviations measure_deviations(const Rendering& reference, std::span<const Image* const> images,
                              const KnownNoise& known);

/// The mean of the images, at least one and of equal sizes, as a float image.
Image mean_of(std::span<const Image* const> images);

}  // namespace photonproof::inline harness_statistics
