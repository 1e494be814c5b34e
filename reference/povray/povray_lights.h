// Lights as POV-Ray light sources. An area light becomes many points that shine with the cosine law.
#pragma once

#include <cstdint>

#include "reference/povray/povray_plan.h"
#include "reference/povray/sdl_text.h"

namespace photonproof::inline reference_povray {

/// More area lights than this are many: rectangles and balls are one point each then.
constexpr std::ptrdiff_t kManyLights = 64;
/// Radiosity's rays see as many of them, one of every few that shines for all of those. Fewer rays that see more are
/// better: of `many-lights` 24 and 256 have a fifth of relmse of 192 and 64 in a third of the time.
constexpr std::ptrdiff_t kLightsForRays = 256;
bool has_many_lights(const PovScene& scene);
/// For how many lights one of them shines.
std::size_t lights_for_one(const PovScene& scene);

/// The macro that write_lights uses.
void write_spot_macro(const PovPlan& plan, SdlWriter& out);

/// Every light that is not left to radiosity; area lights as `points` says, all of them together.
void write_lights(const PovScene& scene, const PovPlan& plan, const PovrayLightPoints& points, std::uint64_t seed,
                  SdlWriter& out);

}  // namespace photonproof::inline reference_povray
