// What has become of one level: judged by its picture, by what the program said, and by how it ended.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reports/stress/stress_record.h"
#include "scenes/images/image.h"

namespace photonproof::inline harness_stress {

/// What came out of one render.
struct LevelEvidence {
  std::optional<Rendering> picture;  ///< of a process that ended with 0, or with 1 where values are not finite
  bool refused = false;              ///< exit code 2 with a message
  std::string ending;                ///< how the process ended: "killed by SIGSEGV"
  std::string message;               ///< the last line on standard error
  std::vector<std::string> losses;   ///< what the stats say the picture lacks
  double relative_bias = 0;          ///< what the stats claim, 0 where they claim none
  double samples = 1;                ///< a pixel
  bool tells_noise = true;  ///< has a variance layer, as our own engines; else means are compared by themselves
};

/// What it has to be.
struct LevelExpectation {
  std::optional<Rendering> picture;  ///< times `factor`
  std::optional<double> radiance;    ///< the same everywhere, also times `factor`
  double factor = 1;
  double samples = 1;     ///< a pixel, of `picture`
  bool is_exact = false;  ///< the engine's pixels are unbiased and independent; else means of blocks are compared
  bool must_refuse = false;
};

struct LevelVerdict {
  LevelOutcome outcome = LevelOutcome::undecided;
  std::string sentence;
  std::optional<double> would_see;
  bool is_wrong = false;         ///< the picture is, whatever was said
  double allowed = 0;            ///< of would_see: what the means may be off by, however many samples there are
  double share_of_expected = 0;  ///< of the square of the rest, which is noise: what the expected picture has of it
};

/// The tests of one look together fail with this probability where all is right.
inline constexpr double level_alpha = 0.001;
/// Right means that a relative error of the mean of this much would have been seen.
inline constexpr double level_power = 0.1;
/// What a photon mapper's means may be off: of the whole image, and of a block of 8 x 8 pixels.
inline constexpr double biased_mean = 0.03, biased_block = 0.1;

LevelVerdict judge_level(const LevelEvidence& evidence, const LevelExpectation& expected);

}  // namespace photonproof::inline harness_stress
