// The camera of a scene without one.
#pragma once

#include "scenes/description/description.h"

namespace photonproof::scene_xml {

/// Mitsuba 2's rule: a perspective camera of 45 degrees on the -z side, centred in x and y, so near that the scene's
/// largest extent fills the view. Shapes without end do not count; of a scene without others it looks at [-1,1]^3.
SensorDescription sensor_around(const SceneDescription& scene);

}  // namespace photonproof::scene_xml
