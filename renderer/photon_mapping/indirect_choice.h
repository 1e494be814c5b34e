// Which way of finding light between diffuse surfaces the photon mapper takes where that is left to it: its maps, path
// tracing beside the caustic map, or path tracing alone. A pilot of some thousand camera paths says how far apart the
// samples of a pixel are each way, V relative to the image as relmse counts, and how many rays one takes; tables of
// what rays and gathers take on the machine that they were measured on turn that into a time C. S samples then have
//   path tracing   relmse V/S
//   the maps       relmse V/S + 3/2 i^2 / M,   M = 700 (N / 1e6)^(2/3)
// after S C. i^2 is the part of the image's square that is indirect, M the photons in a disc after N photons in all: a
// gather's variance is 1/M, and its squared bias half of that at the best radius (gather_bias.h). So maps win early
// and path tracing late, and what is asked for decides.
// Path tracing alone finds caustics by rays that happen to meet lights. From a light much brighter than the image they
// are too rare for a pilot to tell how far they scatter it: there the caustic map stays.
#pragma once

#include <optional>
#include <string>

#include "renderer/photon_mapping/photon_maps.h"

namespace photonproof::inline renderer_photon_mapping {

/// Of the pilot, or a few more.
inline constexpr int pilot_camera_paths = 8192;

/// One way, as the pilot found it.
struct WayOfLight {
  double variance = 0;     ///< of a camera sample: mean over channel values of variance / (mean^2 + 0.01)
  double nanoseconds = 0;  ///< of a camera sample, photons included
};

struct IndirectPilot {
  WayOfLight maps, beside_caustics;
  std::optional<WayOfLight> paths_alone;  ///< where they can tell their error
  bool caustics = false;                  ///< whether there is a caustic map
  double indirect_square = 0;             ///< i^2
  double photons_a_sample = 0;            ///< N / S
  double pixels = 1;
};

struct IndirectChoice {
  IndirectLight indirect = IndirectLight::map;
  bool caustic_map = true;  ///< if the scene has caustics
  std::string why;          ///< a sentence
};

/// The way that is first at the error asked for, or nearest to the image after the samples or the time asked for.
/// Another way than the maps must be plainly first.
IndirectChoice choose_indirect(const IndirectPilot& pilot, const RenderBudget& budget, std::int64_t samples);

/// A clause about maps of a scene whose emission_misses_planes (light_sampling/scene_lights.h).
inline constexpr const char* light_that_maps_miss =
    "photon maps miss what a plane without end throws back, from afar, of light from infinity";

/// Traces the pilot's paths and chooses; path tracing where maps would miss light.
IndirectChoice choose_indirect(const PhotonSource& source, const PhotonMaps& maps, const RenderPlan& plan,
                               const Tile& window, RenderStats& stats);

}  // namespace photonproof::inline renderer_photon_mapping
