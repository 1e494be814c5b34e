// How often a level is rendered and with how many samples, until it is known what it is.
#pragma once

#include <optional>

#include "harness/stress/level_judge.h"

namespace photonproof::inline harness_stress {

/// One look at a level: a render with a seed of its own.
struct LevelLook {
  int number = 1, samples = 64;  ///< a pixel
  int expected_from = 256;       ///< samples a pixel of what is expected; of no account where it is a closed form
};

/// What looks wrong, or has no noise that is known, is looked at once more, with four times the samples, or with as
/// many where four times are more than `most_samples`. No noise makes it right.
///
/// What noise hides is looked at again where noise can fall enough, which its square does with the samples' number:
/// with as many as that needs, to a power of two. What is expected gets four times as many where it has half of the
/// square that may be left; levels share it. How large noise is, is known to a factor of two of its square, and hardly
/// for more than eight times the samples; so no look has more than that, and there are three at least, of four times
/// the samples each, at what seems out of reach. All others have `most_samples` a pixel at most, what is expected half
/// as many.
std::optional<LevelLook> next_look(const LevelVerdict& verdict, const LevelLook& last, double most_samples);

}  // namespace photonproof::inline harness_stress
