// The sun seen from the ground through clear air: Hosek and Wilkie 2013, "Adding a Solar-Radiance Function to the
// Hosek-Wilkie Skylight Model", as Mitsuba's sunsky has it: the irradiance of their disc, the same in all of it.
#pragma once

#include <array>

#include "scenes/base/vec.h"

namespace photonproof::inline scenes_sky {

inline constexpr std::size_t sun_turbidities = 10, sun_heights = 30;
inline constexpr double sun_first_height = 2, sun_height_step = 3;  ///< degrees

/// By turbidity from 1 and height; linear Rec. 709, whose blue is negative where the sun is lowest.
extern const std::array<std::array<double, 3>, sun_turbidities * sun_heights> sun_irradiance_table;

/// On a surface that faces the sun, in the units of clear_sky.h times sr. Linear between the table's turbidities and
/// heights, and the same below its first height and above its last. Turbidity from 1 to 10; height in degrees.
RgbD sun_irradiance(double height, double turbidity);

}  // namespace photonproof::inline scenes_sky
