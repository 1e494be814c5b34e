// Faces of glass that lie nearer to each other than rays leave a surface by: a ray that leaves one starts beyond the
// other, and its light is bent at one of them alone.
#pragma once

#include <cstddef>
#include <vector>

#include "renderer/scene/scene_frame.h"
#include "scenes/description/description.h"

namespace photonproof::inline renderer_limits {

/// Rays leave a surface by four steps of its coordinates (surface_hit.h), and their origins are rounded: faces so many
/// steps apart they take for one.
inline constexpr double steps_resolved = 6 * 0x1p-23;

/// Two shapes by their numbers in the description, the earlier first.
struct CloseFaces {
  std::size_t first = 0, second = 0;
  double apart = 0;     ///< at most so far, in the description's lengths
  double resolved = 0;  ///< what single precision tells apart there
};

/// Of spheres, rectangles and cubes whose own BSDF is a dielectric; one pair of faces for every two shapes.
std::vector<CloseFaces> close_faces_of_glass(const SceneDescription& description, const SceneFrame& frame);

}  // namespace photonproof::inline renderer_limits
