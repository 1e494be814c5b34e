// Irradiance of the sun on the ground through clear air, as in Mitsuba's sunsky. The disc is uniform. Source: Hosek and
// Wilkie 2013, "Adding a Solar-Radiance Function to the Hosek-Wilkie Skylight Model".
#pragma once

#include <array>

#include "scenes/base/vec.h"

namespace photonproof::inline scenes_sky {

inline constexpr std::size_t sun_turbidities = 10, sun_heights = 30;
inline constexpr double sun_first_height = 2, sun_height_step = 3;  ///< degrees

/// Indexed by turbidity from 1 and by height; linear Rec. 709, whose blue is negative where the sun is lowest.
extern const std::array<std::array<double, 3>, sun_turbidities * sun_heights> sun_irradiance_table;

/// Irradiance on a surface that faces the sun, in the units of clear_sky.h times sr. Linear between the table's
/// turbidities and heights, constant below its first height and above its last. Turbidity from 1 to 10; height in
/// degrees.
RgbD sun_irradiance(double height, double turbidity);

}  // namespace photonproof::inline scenes_sky
