// Indirect light by paths: POV-Ray's radiosity with nothing to be reused. Its cache averages over a reach that doubles
// with every bounce, as does the error it allows (source/backend/lighting/radiosity.cpp of POV-Ray 3.7), so that where
// light falls off along its way it is too bright: by 117 % in `corridor`. Without the cache there is noise in its
// place.
//
// - A sample is kept only if nothing is nearer than 1e-4 of the maximum reuse distance. With a huge one none is, where
//   every ray meets something: a black ball around everything, for radiosity's rays alone.
// - Of a point's rays those beyond its `importance` are dropped before they are shaded, and the others weigh more: 4 of
//   20 from what is seen, 2 of 10 from what they meet, then 1 of 5.
// - All bounces from the third on take every fifth direction of one sequence, in step: paths that leave each surface by
//   the same angles, at -37 % in `corridor`. So a quarter of every twin is black, in a pattern of cells far smaller
//   than anything that is seen, and the rest is 4/3 as bright: paths end by chance (Russian roulette: Arvo and Kirk
//   1990), and bounces fall out of step.
#pragma once

#include <cstdint>
#include <string>

#include "reference/povray/povray_camera.h"
#include "reference/povray/povray_plan.h"
#include "reference/povray/sdl_text.h"

namespace photonproof::inline reference_povray {

/// "radiosity{...}" of the global settings.
std::string path_radiosity_sdl(const PovPlan& plan);

/// What every object is told of its share of rays.
std::string importance_sdl(const PovPlan& plan);

/// The ball, and the pattern that says where paths end; another one for each seed.
void write_fate(std::uint64_t seed, SdlWriter& out);

/// A camera of a picture this many sub-pixels across and down, whose middles lie elsewhere in them for each seed,
/// evenly over a sub-pixel: edges, which a fixed grid puts to within half of one (the hole of `keyhole`: -0.4 % of its
/// light), are right in the mean over seeds. Parallel and fisheye cameras stay as they are.
PovCamera with_moved_grid(PovCamera camera, int across, int down, std::uint64_t seed);

/// As material_of (povray_materials.h), but that paths end in a quarter of what is diffuse; mirrors, coats and what is
/// partly clear are as they were.
std::string mortal_material_of(const PovScene& scene, const PovSurface& surface, const PovPlan& plan);

}  // namespace photonproof::inline reference_povray
