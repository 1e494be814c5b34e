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

/// Each image has the right one's brightness in the median of lit points. For cosines there is a second image with the
/// brightness of the formula. Empty where lights are not rectangles. `direct` is the right image, at these points.
std::vector<DirectMistake> direct_mistakes(const SceneDescription& scene, const std::vector<SeenPlace>& points,
                                           const Image& direct);

}  // namespace photonproof::inline harness_diagnosis
