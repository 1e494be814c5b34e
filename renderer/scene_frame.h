// Where the compiled scene puts its origin, since single precision is finest around it.
#pragma once

#include "scenes/description.h"

namespace photonproof {

struct SceneFrame {
  Vec3d moved{0.0};            ///< added to the description's coordinates
  float coordinate_floor = 1;  ///< least magnitude of coordinates that ray offsets reckon with
};

/// The origin is the median of the shapes' middles, axis by axis: one shape far away, or one so large that its middle
/// is, does not cost the others their precision. The floor, a sixteenth of the median reach from there, is for points
/// near the origin, which still come out of arithmetic with the scene's coordinates.
SceneFrame scene_frame(const SceneDescription& description);

}  // namespace photonproof
