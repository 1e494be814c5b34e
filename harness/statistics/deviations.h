// Independent images of one expectation against a reference: how far their mean is off in every pixel, in every block
// of 8 x 8 pixels and overall, and how far chance could have put it. All statistics of gates rest on these.
//
// Chance is known from how the images differ among themselves, and from nothing the engine says of itself. Few images
// say little of one pixel's variance, so it is steadied by its neighbours' (student.h, freedom_of_expectation):
// - A pixel's is expected to be its block's mean one, a block's to be what its pixels' would make it were they
//   independent, times the mean factor by which the blocks differ from that (light tracers and photon maps correlate
//   pixels). How much these expectations are worth is measured, too, a block or a channel at a time.
// - What is left of not knowing is in the degrees of freedom of Student's t.
// - A pixel's mean of a few skewed images is skewed, and its upper tail longer than normal's: it is taken as that of
//   the Gamma distribution with the skewness that the block's pixels show together.
// - Where pixels or blocks share noise, all of them may look steady and be wrong together: an expectation is worth no
//   more than the independent ones among them (shared_noise.h).
// - Rare bright samples that some images met tell of those that others did not (deviation.h). A block's third moments
//   over its second are what one adds to a pixel: f of a Poisson number of samples of f each, and about 0 of normal
//   noise. Any block may miss the brightest ones that any other met, in proportion to its brightness at most.
// - The whole image's variance has no neighbours: it has the degrees of freedom of the images' number.
// - A committed reference is rounded to half floats at random (reference/store/half_rounding.h). Its variance knows
//   that, but a value that goes up once in a thousand is no normal one: each pixel of the reference is taken to be as
//   uncertain as that rounding can make it, 2^-11 of its value.
// - Rounding of sums counts as a deviation of 1e-5 of the value, so that pixels without noise compare as equal.
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
  std::vector<Block> places;                     ///< of the blocks
  std::array<std::vector<Deviation>, 3> pixels;  ///< row-major, by channel
  std::array<std::vector<Deviation>, 3> blocks;  ///< as `places`
  std::array<Deviation, 3> whole;
  /// Means in which certain places count more (weighed_mean.h). Known where two pictures have variance layers.
  std::optional<std::array<Deviation, 3>> weighed{};
  std::array<double, 3> independent_blocks{};  ///< by channel: the noise of as many varies as that of `blocks` does
};

/// What is known of the noise besides how the images differ.
struct KnownNoise {
  double reference_freedom = 1;  ///< degrees of freedom of the reference's variance
  /// Of each pixel of one image: no less than this counts. It helps where images are too few to have met rare bright
  /// samples that the reference has met: a light smaller than a pixel, met by half of the images, is met by none of
  /// eight in one gate of 256.
  const Image* least_variance = nullptr;
  /// A pixel of one image. Stratified samples fall on the two sides of an edge in the same numbers in nearly every
  /// image, and not in the expected ones: a pixel alone may be off by one sample of the contrast around it.
  std::optional<double> samples{};
};

/// Preconditions: at least two images; equal sizes, finite values, a reference with variance.
Deviations measure_deviations(const Rendering& reference, std::span<const Image* const> images,
                              const KnownNoise& known);

/// The mean of the images, at least one and of equal sizes, as a float image.
Image mean_of(std::span<const Image* const> images);

}  // namespace photonproof::inline harness_statistics
