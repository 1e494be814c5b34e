// Direct light with a factor of its formula, E = L A cos(surface) cos(light) / r^2, left out or taken twice.
#pragma once

#include <string>
#include <vector>

#include "harness/diagnosis/seen_objects.h"
#include "scenes/description/description.h"
#include "scenes/images/image.h"

namespace photonproof::inline harness_diagnosis {

struct DirectMistake {
  std::string kind, sentence, cause;
  Image direct;
};

/// Each as bright as the right one in the median of what is lit, and those of cosines also as bright as the formula
/// then says. Empty where lights are not rectangles. `direct` is the right one, of the points' image.
std::vector<DirectMistake> direct_mistakes(const SceneDescription& scene, const std::vector<SeenPlace>& points,
                                           const Image& direct);

}  // namespace photonproof::inline harness_diagnosis
