// What is broken in a picture whatever it shows: values that are not finite, nothing but one colour, lines and tiles
// that were never rendered, specks. Found at full resolution, and left out of what is compared later.
#pragma once

#include <cstdint>
#include <vector>

#include "harness/diagnosis/diagnosis.h"

namespace photonproof::inline harness_diagnosis {

struct Breakage {
  std::vector<Finding> findings;
  std::vector<std::uint8_t> ignored;  ///< a pixel: 1 where it is broken
  bool has_fireflies = false;         ///< among what is ignored
  bool hopeless = false;              ///< there is nothing to compare
};

/// Precondition: both have the size of the reference.
Breakage find_breakage(const Image& submitted, const SceneKnowledge& knowledge);

}  // namespace photonproof::inline harness_diagnosis
