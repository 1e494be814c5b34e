// Defects of a picture that do not depend on its scene: values that are not finite, a single colour, lines and tiles
// that were never rendered, and specks. They are found at full resolution, and later comparisons leave them out.
#pragma once

#include <cstdint>
#include <vector>

#include "harness/diagnosis/diagnosis.h"

namespace photonproof::inline harness_diagnosis {

struct Breakage {
  std::vector<Finding> findings;
  std::vector<std::uint8_t> ignored;  ///< a pixel: 1 where it is broken
  bool has_fireflies = false;         ///< some ignored pixels are fireflies
  bool hopeless = false;              ///< there is nothing to compare
};

/// Precondition: both have the size of the reference.
Breakage find_breakage(const Image& submitted, const SceneKnowledge& knowledge);

}  // namespace photonproof::inline harness_diagnosis
