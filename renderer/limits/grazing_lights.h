// Lights that graze what they light: from just above a surface, or along a face. The cosine there is a small difference
// of numbers that single precision rounds, and what it loses of the cosine it loses of the light.
#pragma once

#include <cstddef>
#include <vector>

#include "renderer/scene/scene_parts.h"

namespace photonproof::inline renderer_limits {

/// One of a light, where it is known worst.
struct GrazingLight {
  std::size_t light = 0;       ///< index into SceneParts::lights
  bool from_one_side = false;  ///< a beam, or a light so far away that it is one
  double height = 0;    ///< of a light above the surface, in the description's lengths; of a beam the sine of its angle
  double rounding = 0;  ///< of that, either way: what single precision may make of it
  double loss() const { return rounding > 0 ? rounding / height : 0; }
};

/// Those whose light on some surface is known to no better than a thousandth. Lights are if they are small and near a
/// surface that is not only a mirror; beams by their angle to half of all flat faces or more, of which instances
/// of many triangles are not asked.
std::vector<GrazingLight> grazing_lights(const SceneParts& scene);

}  // namespace photonproof::inline renderer_limits
