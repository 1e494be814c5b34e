// Sensors: the camera of a scene without one, and the films that meters and batches of cameras can have.
#pragma once

#include <string>

#include "scenes/description/description.h"

namespace photonproof::inline scenes_description {

/// A perspective camera as Mitsuba 2 adds one, on the -z side and centred in x and y. It is so near that the scene's
/// largest extent fills 45 degrees, here along the picture's shorter side. With `front` it is on the +z side, to which
/// models of other formats turn their front. Shapes without end do not count. Without any other it looks at [-1,1]^3.
SensorDescription sensor_around(const SceneDescription& scene, bool front);

/// Whether the sensor measures one value: a radiancemeter, an irradiancemeter or a distant one.
bool is_meter(const SensorDescription& sensor);

/// The problem of a sensor's film, as a clause after the sensor's name; empty where there is none. A meter has one
/// pixel. A batch shares the columns among its cameras.
std::string film_problem(const SensorDescription& sensor);

}  // namespace photonproof::inline scenes_description
