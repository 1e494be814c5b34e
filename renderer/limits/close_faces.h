// Faces of glass closer together than the offset of rays from a surface. A ray that leaves one starts beyond the other,
// so its light is bent at only one of them.
#pragma once

#include <cstddef>
#include <vector>

#include "renderer/scene/scene_frame.h"
#include "scenes/description/description.h"

namespace photonproof::inline renderer_limits {

/// Rays leave a surface by four steps of its coordinates (surface_hit.h), and their origins are rounded. Faces less
/// than this many steps apart count as one.
inline constexpr double steps_resolved = 6 * 0x1p-23;

/// Two shapes by their numbers in the description, the earlier first.
struct CloseFaces {
  std::size_t first = 0, second = 0;
  double apart = 0;     ///< an upper bound so far, in the description's lengths
  double resolved = 0;  ///< the smallest distance that single precision resolves there
};

/// Pairs among spheres, rectangles and cubes whose own BSDF is a dielectric; one pair of faces for every two shapes.
/// `compared`, where given, grows by the number of pairs of faces that were compared.
std::vector<CloseFaces> close_faces_of_glass(const SceneDescription& description, const SceneFrame& frame,
                                             std::size_t* compared = nullptr);

}  // namespace photonproof::inline renderer_limits
