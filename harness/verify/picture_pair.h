// Do two engines show the same scene? Both have noise, and one may declare an error besides: gates' statistics judge
// how far apart they are (harness/statistics/picture_noise.h, gate_statistics.h). A pair that does not differ says
// which error would have been seen.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "harness/statistics/gate_statistics.h"
#include "harness/verify/engine_picture.h"
#include "reports/record/results.h"
#include "scenes/base/vec.h"

namespace photonproof::inline harness_verify {

/// By chance a pair of right engines differs with this probability; what differs is looked at again with new samples.
inline constexpr double pair_alpha = 1e-4;

struct PairTest {
  bool differs = false;
  bool has_outlier = false;         ///< one pixel holds more light than chance gives a right engine: see below
  bool is_undecided = false;        ///< the model of noise does not hold: `sentence` says why, nothing is proven
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

/// What two engines may differ by.
AllowedError both_declare(const EnginePicture& first, const EnginePicture& second);

/// A pair is undecided where rare bright samples that either may have missed explain the difference. It is undecided,
/// too, where an engine without a variance layer gave fewer pictures than gates need (least_images).
///
/// By Markov's inequality an unbiased mean that is never negative exceeds k times what it should be with a probability
/// of at most 1/k; so in any pixel of a picture it exceeds k times the light of all pixels with no larger one, whatever
/// its noise. A pixel with 6 / alpha times the other picture's light is wrong, in one of six channels: `has_outlier`.
PairTest test_pair(const EnginePicture& first, const EnginePicture& second, double alpha = pair_alpha);

/// The picture's mean against the one that a closed form states, which counts as right to 1e-5.
PairTest test_against_closed_form(const RgbD& mean, const EnginePicture& picture);

/// What would be seen of the picture's error by one without noise.
std::optional<double> would_see_alone(const EnginePicture& picture);

}  // namespace photonproof::inline harness_verify
