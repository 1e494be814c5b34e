// Lights so near a surface that camera paths lose them: small ones, which are brightest in a spot that next to no path
// meets, and flat ones that rays cannot tell from what they lie on.
#pragma once

#include <cstddef>
#include <vector>

#include "renderer/scene/scene_parts.h"

namespace photonproof::inline renderer_limits {

struct NearLight {
  std::size_t light = 0;  ///< index into SceneParts::lights
  double height = 0;      ///< of its middle above the nearest surface, in the description's lengths
  double resolved = 0;    ///< what rays tell apart there, in the same
};

/// Lights that shine onto a surface, not only a mirror, no further away than `within` (the description's lengths), and
/// are smaller than that; the height counts as no less than half of their size.
std::vector<NearLight> lights_above_spots(const SceneParts& scene, double within);

/// Rectangles and disks that emit, in the middle of which another surface is nearer than is resolved. Of `null` BSDFs
/// there is none.
std::vector<NearLight> lights_on_surfaces(const SceneParts& scene);

}  // namespace photonproof::inline renderer_limits
