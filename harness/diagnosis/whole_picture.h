// A defect of the picture as a whole that is no change of it: noise.
#pragma once

#include <optional>

#include "harness/diagnosis/diagnosis.h"
#include "harness/diagnosis/pictures/comparison.h"

namespace photonproof::inline harness_diagnosis {

/// A finding where the picture's noise is large, and far above the reference's.
std::optional<Finding> find_noise(const Comparison& comparison, const SceneKnowledge& knowledge);

}  // namespace photonproof::inline harness_diagnosis
