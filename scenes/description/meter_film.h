// Films that sensors of one pixel and batches of cameras can have.
#pragma once

#include <string>

#include "scenes/description/view_description.h"

namespace photonproof::inline scenes_description {

/// Whether the sensor measures one value: a radiancemeter, an irradiancemeter or a distant one.
bool is_meter(const SensorDescription& sensor);

/// The problem of a sensor's film, as a clause after the sensor's name; empty where there is none. A meter has one
/// pixel. A batch shares the columns among its cameras.
std::string film_problem(const SensorDescription& sensor);

}  // namespace photonproof::inline scenes_description
