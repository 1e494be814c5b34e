// Lights as POV-Ray light sources. An area light becomes many points that emit with the cosine law.
#pragma once

#include <cstdint>

#include "reference/povray/povray_plan.h"
#include "reference/povray/sdl_text.h"

namespace photonproof::inline reference_povray {

/// With more area lights than this, each rectangle or ball becomes one point.
constexpr std::ptrdiff_t kManyLights = 64;
/// Lights that radiosity's rays see: one of every few, with the flux of all of those. Fewer rays that see more lights
/// are better. In `many-lights`, 24 rays and 256 lights have a fifth of the relmse of 192 rays and 64 lights, in a
/// third of the time.
constexpr std::ptrdiff_t kLightsForRays = 256;
bool has_many_lights(const PovScene& scene);
/// The number of lights that one light stands for.
std::size_t lights_for_one(const PovScene& scene);

/// The macro that write_lights uses.
void write_spot_macro(const PovPlan& plan, SdlWriter& out);

/// Every light that is not left to radiosity; area lights as `points` specifies, all of them together.
void write_lights(const PovScene& scene, const PovPlan& plan, const PovrayLightPoints& points, std::uint64_t seed,
                  SdlWriter& out);

}  // namespace photonproof::inline reference_povray
