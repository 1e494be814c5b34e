// Mistakes too faint for blocks to show. A matched filter looks for the whole pattern of a change at once. B is the
// change of a mistake or of a feature's loss. D is the difference of the picture (both as square roots, comparison.h),
// and s^2 the variance of a pixel's noise. Then x = sum(B D / s^2) / sum(B^2 / s^2) is the amount of the change.
#pragma once

#include <optional>
#include <string>

#include "harness/diagnosis/guess.h"

namespace photonproof::inline harness_diagnosis {

/// Whether enough differs beyond noise to look for mistakes. Renders nothing.
bool could_hide_a_mistake(const Guess& guess, const SceneKnowledge& knowledge, const Comparison& comparison);

/// Finds a change that is there in full (x about 1; for light of features, x > 0.4) and far above its uncertainty. It
/// must explain more than 5 % of the squared difference beyond noise.
std::optional<Candidate> faint_mistake(const Guess& guess, const SceneKnowledge& knowledge,
                                       const Comparison& comparison);

/// The same, only for fine patterns and for the look of single objects.
std::optional<Candidate> faint_pattern(const Guess& guess, const SceneKnowledge& knowledge,
                                       const Comparison& comparison);

/// The finding for a feature's light times a factor.
Finding feature_finding(const std::string& feature, double factor);

}  // namespace photonproof::inline harness_diagnosis
