// Lights so near a surface that camera paths lose their light. Small ones are brightest in a spot that almost no path
// meets. Rays cannot separate flat ones from the surface they lie on.
#pragma once

#include <cstddef>
#include <vector>

#include "renderer/scene/scene_parts.h"

namespace photonproof::inline renderer_limits {

struct NearLight {
  std::size_t light = 0;  ///< index into SceneParts::lights
  double height = 0;      ///< of its middle above the nearest surface, in the description's lengths
  double resolved = 0;    ///< the smallest distance that rays resolve there, in the same lengths
};

/// Lights that shine onto a surface, not only a mirror, no further away than `within` (in the description's lengths),
/// and are smaller than that. The height counts as at least half of their size.
std::vector<NearLight> lights_above_spots(const SceneParts& scene, double within);

/// Rectangles and disks that emit, with another surface at their middle nearer than is resolved. Surfaces of `null`
/// BSDFs do not count.
std::vector<NearLight> lights_on_surfaces(const SceneParts& scene);

}  // namespace photonproof::inline renderer_limits
