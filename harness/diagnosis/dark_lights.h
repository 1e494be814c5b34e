// Lights that come out dark, as overflow in 8 bits makes them. How dark they become depends on how much brighter
// than white they are, which a reference of 8 bits does not hold. Small lights are all edge, where blocks show nothing.
#pragma once

#include <optional>

#include "harness/diagnosis/diagnosis.h"

namespace photonproof::inline harness_diagnosis {

/// Where nothing else is found. Precondition: both pictures have one size.
std::optional<Finding> find_dark_lights(const Image& submitted, const SceneKnowledge& knowledge);

}  // namespace photonproof::inline harness_diagnosis
