// Lights as POV-Ray light sources. An area light becomes many points that shine with the cosine law.
#pragma once

#include <cstdint>
#include <vector>

#include "reference/povray/povray_plan.h"
#include "reference/povray/sdl_text.h"

namespace photonproof {

/// N x N points of the unit square, one in every cell of an N x N grid and one in every column and row of an N^2 grid
/// (correlated multi-jittered sampling, Kensler 2013), for every N of at least 1. The same seed gives the same points.
std::vector<Vec2<double>> square_points(int n, std::uint64_t seed);

/// Unit vectors spread evenly over the sphere along a Fibonacci spiral (Swinbank and Purser 2006), turned by the seed.
std::vector<Vec3d> sphere_points(int count, std::uint64_t seed);

/// The macro that write_lights uses.
void write_spot_macro(const PovPlan& plan, SdlWriter& out);

/// Every light that is not left to radiosity; area lights as `points` says, all of them together.
void write_lights(const PovScene& scene, const PovPlan& plan, const PovrayLightPoints& points, std::uint64_t seed,
                  SdlWriter& out);

}  // namespace photonproof
