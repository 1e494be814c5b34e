// Do two engines show the same scene? Both pictures have noise, and an engine may declare an error besides. The gates'
// statistics test how far apart they are (harness/statistics/picture_noise.h, gate_statistics.h). A pair that does not
// differ gives its minimum detectable error.
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

/// Probability that a pair of right engines differs by chance. A pair that differs is tested again with new samples.
inline constexpr double pair_alpha = 1e-4;

struct PairTest {
  bool differs = false;
  bool has_outlier = false;         ///< one pixel holds more light than chance gives a right engine: see below
  bool is_undecided = false;        ///< the noise model does not hold: `sentence` has the reason, nothing is proven
  std::array<double, 3> shift{};    ///< of the mean over the image, by channel, relative to the first's; 0 where black
  double whole_shift = 0;           ///< of the channels that differ together, else of all: the one in `sentence`
  std::array<bool, 3> channels{};   ///< that differ
  bool whole_differs = false;       ///< the mean differs, not only places
  std::string sentence;             ///< "-4.1 % over 33 px at (40, 12), red only"
  std::optional<double> would_see;  ///< minimum detectable relative error of the mean, with probability 0.99
  std::vector<FailingTile> tiles;   ///< worst first
  double relmse = 0;
  std::optional<double> ssim;
};

/// Deviation of the second from the first. Preconditions: equal sizes, finite values, variances.
Deviations deviations_between(const EnginePicture& first, const EnginePicture& second);

/// The difference that the two engines' declared errors allow.
AllowedError both_declare(const EnginePicture& first, const EnginePicture& second);

/// A pair is undecided if rare bright samples that either may have missed explain the difference. It is also undecided
/// if an engine without a variance layer gave fewer pictures than gates need (least_images).
///
/// By Markov's inequality an unbiased mean that is never negative exceeds k times its expectation with probability at
/// most 1/k. So the probability that any pixel exceeds k times the light of all pixels is at most 1/k too, whatever its
/// noise. A pixel with 6 / alpha times the other picture's light, in one of six channels, is wrong: `has_outlier`.
PairTest test_pair(const EnginePicture& first, const EnginePicture& second, double alpha = pair_alpha);

/// Compares the picture's mean with that of a closed form, which counts as right to 1e-5.
PairTest test_against_closed_form(const RgbD& mean, const EnginePicture& picture);

/// Largest relative difference between the pictures of a test, in a channel of the whole image or of a failing tile.
double largest_difference(const PairTest& test, const EnginePicture& first, const EnginePicture& second);

/// Minimum detectable error of the picture against one without noise.
std::optional<double> would_see_alone(const EnginePicture& picture);

}  // namespace photonproof::inline harness_verify
