// Judges one level by its picture, the program's warnings, and how the process ended.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reports/stress/stress_record.h"
#include "scenes/images/image.h"

namespace photonproof::inline harness_stress {

/// The result of one render.
struct LevelEvidence {
  std::optional<Rendering> picture;  ///< From a process that ended with 0, or with 1 where values are not finite.
  bool refused = false;              ///< Exit code 2 with a message.
  std::string ending;                ///< The end of the process: "killed by SIGSEGV".
  std::string message;               ///< The last line on standard error.
  std::vector<std::string> losses;   ///< Losses of the picture that the stats list.
  double relative_bias = 0;          ///< The bias that the stats state, else 0.
  double samples = 1;                ///< Samples a pixel.
  bool states_noise = true;          ///< Has a variance layer, like our own engines; else only means are compared.
};

/// The expected result.
struct LevelExpectation {
  std::optional<Rendering> picture;  ///< Times `factor`.
  std::optional<double> radiance;    ///< Equal everywhere, also times `factor`.
  double factor = 1;
  double samples = 1;     ///< Samples a pixel of `picture`.
  bool is_exact = false;  ///< The engine's pixels are unbiased and independent; else means of blocks are compared.
  bool must_refuse = false;
};

struct LevelVerdict {
  LevelOutcome outcome = LevelOutcome::undecided;
  std::string sentence;
  std::optional<double> would_see;
  bool is_wrong = false;         ///< The picture is wrong, with or without a warning.
  double allowed = 0;            ///< The part of would_see that the means may be off by for any number of samples.
  double share_of_expected = 0;  ///< The expected picture's share of the square of the other part, which is noise.
};

/// The probability that the tests of one look together fail for a right picture.
inline constexpr double level_alpha = 0.001;
/// A right level's mean has a minimum detectable relative error of at most this much.
inline constexpr double level_power = 0.1;
/// Allowed relative errors of a photon mapper's means: of the whole image, and of a block of 8 x 8 pixels.
inline constexpr double biased_mean = 0.03, biased_block = 0.1;

LevelVerdict judge_level(const LevelEvidence& evidence, const LevelExpectation& expected);

}  // namespace photonproof::inline harness_stress
