// The camera of a scene without one.
#pragma once

#include "scenes/description/description.h"

namespace photonproof::inline scenes_description {

/// A perspective camera as Mitsuba 2 adds one, on the -z side and centred in x and y. It is so near that the scene's
/// largest extent fills 45 degrees, here along the picture's shorter side. With `front` it is on the +z side, to which
/// models of other formats turn their front. Shapes without end do not count. Without any other it looks at [-1,1]^3.
SensorDescription sensor_around(const SceneDescription& scene, bool front);

}  // namespace photonproof::inline scenes_description
