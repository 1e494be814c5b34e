// Mistakes too faint for blocks to show. The whole pattern of what would change is looked for at once, as a matched
// filter does: with B the change of a mistake or a feature's loss, D what the picture differs by (both as square roots,
// comparison.h) and noise of variance s^2 a pixel, x = sum(B D / s^2) / sum(B^2 / s^2) is how much of it is there.
#pragma once

#include <optional>
#include <string>

#include "harness/diagnosis/guess.h"

namespace photonproof::inline harness_diagnosis {

/// Whether so much differs beyond noise that it is worth looking. Renders nothing.
bool could_hide_a_mistake(const Guess& guess, const SceneKnowledge& knowledge, const Comparison& comparison);

/// Only what is there in full (x about 1), far above its uncertainty, and accounts for most of what differs beyond
/// noise.
std::optional<Candidate> faint_mistake(const Guess& guess, const SceneKnowledge& knowledge,
                                       const Comparison& comparison);

/// The same of fine patterns, and of what single bodies look like, alone.
std::optional<Candidate> faint_pattern(const Guess& guess, const SceneKnowledge& knowledge,
                                       const Comparison& comparison);

/// How a feature's light times a factor is put.
Finding words_of_feature(const std::string& feature, double factor);

}  // namespace photonproof::inline harness_diagnosis
