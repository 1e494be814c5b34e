// Lights that come out dark, as overflow in 8 bits makes them. Their darkness depends on how much brighter than white
// they are, which a reference of 8 bits does not hold. Small lights consist of edges, where blocks show nothing.
#pragma once

#include <optional>

#include "harness/diagnosis/diagnosis.h"

namespace photonproof::inline harness_diagnosis {

/// Used where nothing else is found. Precondition: both pictures have one size.
std::optional<Finding> find_dark_lights(const Image& submitted, const SceneKnowledge& knowledge);

}  // namespace photonproof::inline harness_diagnosis
