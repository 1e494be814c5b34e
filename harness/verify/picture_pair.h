// Do two engines show the same scene? Where both are unbiased it is `agreement` (harness/statistics/agreement.h); where
// one declares an error, the means of the whole image and of blocks of 8 x 8 pixels may differ by what both declare and
// by their noise. Either way a pair that does not differ says which error would have been seen.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "harness/statistics/deviations.h"
#include "harness/verify/engine_picture.h"
#include "reports/record/results.h"
#include "scenes/meshes/vec.h"

namespace photonproof {

/// By chance a pair of right engines differs with this probability; what differs is looked at again with new samples.
inline constexpr double pair_alpha = 1e-4;

struct PairTest {
  bool differs = false;
  bool has_outlier = false;         ///< one pixel holds more light than chance gives a right engine: see below
  bool by_few_samples = false;      ///< they would, were it not for light that comes in few bright samples: see below
  std::array<double, 3> shift{};    ///< of the mean over the image, by channel, relative to the first's; 0 where black
  double whole_shift = 0;           ///< of the channels that differ together, else of all: what `sentence` says
  std::array<bool, 3> channels{};   ///< that differ
  bool whole_differs = false;       ///< the mean does, not places alone
  std::string sentence;             ///< "-4.1 % over 33 px at (40, 12), red only"
  std::optional<double> would_see;  ///< the least relative error of the mean that shows with probability 0.99
  std::vector<FailingTile> tiles;   ///< worst first
  double relmse = 0;
  std::optional<double> ssim;
};

/// How far the second is from the first. Preconditions: equal sizes, finite values, variances.
Deviations deviations_between(const EnginePicture& first, const EnginePicture& second);

/// How far a block's channel is beyond what both declare and noise explains, in standard errors; 0 where it is not.
double excess_of_block(const Deviations& deviations, const DeclaredError& declared, std::size_t block,
                       std::size_t channel);

/// What two engines may differ by.
DeclaredError both_declare(const EnginePicture& first, const EnginePicture& second);

/// Light that comes in samples worth f each, in units of a pixel's value, has a variance of f times the light; so what
/// one of two pictures lacks of it, D, is D / f samples, and chance leaves out as many as chi^2 allows: about twenty of
/// a whole image. A variance that was estimated where none arrived says less (agreement.h). f is the brightest sample
/// of either picture anywhere, variance over value of the pixel where that is largest. A difference that so large
/// samples explain is none that proves anything: `by_few_samples`, and `sentence` says what it is.
///
/// By Markov's inequality an unbiased mean that is never negative exceeds k times what it should be with a probability
/// of at most 1/k; so in any pixel of a picture it exceeds k times the light of all pixels with no larger one, whatever
/// its noise. A pixel with 6 / alpha times the other picture's light is wrong, in one of six channels: `has_outlier`.
PairTest test_pair(const EnginePicture& first, const EnginePicture& second, double alpha = pair_alpha);

/// The picture's mean against the one that a closed form states, which counts as right to 1e-5.
PairTest test_against_closed_form(const RgbD& mean, const EnginePicture& picture);

/// What would be seen of the picture's error by one without noise.
std::optional<double> would_see_alone(const EnginePicture& picture);

}  // namespace photonproof
