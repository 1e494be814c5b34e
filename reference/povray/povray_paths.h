// Indirect light by paths: POV-Ray's radiosity without its cache, with noise instead. The cache averages over a
// distance that doubles with every bounce, as does its allowed error (source/backend/lighting/radiosity.cpp of POV-Ray
// 3.7). Where light falls off along its path the cache is therefore too bright: by 117 % in `corridor`.
//
// POV-Ray keeps a sample only if nothing is nearer than 1e-4 of the maximum reuse distance. With a huge distance it
// keeps none whose rays meet something. A black ball around everything, for radiosity's rays only, stops every ray.
//
// POV-Ray drops the rays of a point beyond its `importance` before shading them, and the others weigh more. A visible
// point keeps 4 of 20, the next one 2 of 10, all others 1 of 5.
//
// All bounces from the third on take every fifth direction of one sequence, in step. Paths that leave each surface by
// the same angles cost 37 % of the light in `corridor`. So a quarter of every twin is black, in a pattern of cells far
// smaller than anything visible, and the rest is 4/3 as bright. Paths then end by chance (Russian roulette: Arvo and
// Kirk 1990), and bounces fall out of step.
#pragma once

#include <cstdint>
#include <string>

#include "reference/povray/povray_camera.h"
#include "reference/povray/povray_plan.h"
#include "reference/povray/sdl_text.h"

namespace photonproof::inline reference_povray {

/// "radiosity{...}" of the global settings.
std::string path_radiosity_sdl(const PovPlan& plan);

/// The declaration of every object's share of rays.
std::string importance_sdl(const PovPlan& plan);

/// The ball, and the pattern that decides where paths end; the pattern differs for each seed.
void write_fate(std::uint64_t seed, SdlWriter& out);

/// A camera whose image has this many sub-pixels across and down. Each seed shifts their centres evenly over a
/// sub-pixel. A fixed grid misplaces edges by up to half a sub-pixel (the hole of `keyhole`: -0.4 % of its light);
/// shifted grids are right in the mean over seeds. Parallel and fisheye cameras are unchanged.
PovCamera with_moved_grid(PovCamera camera, int across, int down, std::uint64_t seed);

/// As material_of (povray_materials.h), except that paths end in a quarter of each diffuse part. Mirrors, coats and
/// partly clear parts are unchanged.
std::string mortal_material_of(const PovScene& scene, const PovSurface& surface, const PovPlan& plan);

}  // namespace photonproof::inline reference_povray
