// The number of renders of a level and their samples, until its outcome is decided.
#pragma once

#include <optional>

#include "harness/stress/level_judge.h"

namespace photonproof::inline harness_stress {

/// One look at a level: a render with its own seed.
struct LevelLook {
  int number = 1, samples = 64;  ///< Samples a pixel.
  int expected_from = 256;       ///< Samples a pixel of the expected picture; unused for a closed form.
};

/// A level that looks wrong, or whose noise is unknown, gets one more look with four times the samples. If four times
/// exceeds `most_samples`, it gets the same number. Noise cannot make it right.
///
/// A level that noise hides gets more looks where noise can fall enough. Its square falls with the number of samples,
/// so the next look has the needed number, to a power of two. The expected picture gets four times the samples where it
/// has over half of the square that may be left; levels share it. Noise is known only to a factor of two of its square,
/// and hardly for more than eight times the samples. So no look has more than eight times. A level whose limit seems
/// out of reach gets at least three looks, each with four times the samples. All other looks have at most
/// `most_samples` a pixel, the expected picture half as many.
std::optional<LevelLook> next_look(const LevelVerdict& verdict, const LevelLook& last, double most_samples);

}  // namespace photonproof::inline harness_stress
