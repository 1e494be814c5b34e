// Automatic choice of the photon mapper's method for light between diffuse surfaces. The methods are its maps, path
// tracing beside the caustic map, and path tracing alone. A pilot of some thousand camera paths measures for each
// method the samples' variance V, relative to the image as in relmse, and the rays of a sample. Measured tables of the
// time of rays and gathers turn these into a time C. After S samples, that is after S C, the expected errors are:
//   path tracing   `relmse V/S`.
//   the maps       `relmse V/S + E(N)`, where E is the error of the best radius with N photons in all
//   (radius_trials.h).
// Where no radii were tried, `E = 3/2 i^2 / M` and `M = 700 (N / 1e6)^(2/3)`. The term i^2 is the indirect part of the
// image's square; M is the number of photons in a disc. A gather's variance is 1/M, and its squared bias half of that
// at the best radius (gather_bias.h). So maps win early, path tracing late, and the requested error, samples or time
// decide. Path tracing alone finds caustics by rays that happen to meet lights. Where a light is much brighter than the
// image, such hits are too rare for a pilot to measure their variance. The caustic map then stays.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "renderer/photon_mapping/photon_maps.h"
#include "renderer/photon_mapping/radius_trials.h"

namespace photonproof::inline renderer_photon_mapping {

/// Camera paths of the pilot; it may trace a few more.
inline constexpr int pilot_camera_paths = 8192;

/// One method, as the pilot measured it.
struct WayOfLight {
  double variance = 0;     ///< of a camera sample: mean over channel values of variance / (mean^2 + 0.01)
  double nanoseconds = 0;  ///< Time of a camera sample, photons included.
};

struct IndirectPilot {
  WayOfLight maps, beside_caustics;
  double areas = 0;                        ///< nanoseconds of the maps' areas on meshes, a camera sample
  std::vector<double> gathers_a_sample{};  ///< by surface
  std::optional<WayOfLight> paths_alone;   ///< Absent where the pilot cannot measure their error.
  bool caustics = false;                   ///< Whether there is a caustic map.
  double indirect_square = 0;              ///< The term i^2 of above.
  RadiusTrials trials{};                   ///< Radii of the global map; may be empty.
  double photons_a_sample = 0;             ///< The ratio N / S.
  double pixels = 1;
};

struct IndirectChoice {
  IndirectLight indirect = IndirectLight::map;
  bool caustic_map = true;  ///< whether to use the caustic map, if the scene has caustics
  std::string why;          ///< the reason, as a sentence
};

/// The method that first reaches the requested error, or the one with the least error after the requested samples or
/// time. A method other than the maps must win plainly.
IndirectChoice choose_indirect(const IndirectPilot& pilot, const RenderBudget& budget, std::int64_t samples);

/// A clause about maps of a scene where emission_misses_planes is true (light_sampling/scene_lights.h).
inline constexpr const char* light_that_maps_miss =
    "photon maps miss what a plane without end throws back, from afar, of light from infinity";

/// Traces the pilot's paths. They cost less than trials of radii where meshes are large.
IndirectPilot pilot_indirect(const PhotonSource& source, const PhotonMaps& maps, const RenderPlan& plan,
                             const Tile& window, RenderStats& stats);

}  // namespace photonproof::inline renderer_photon_mapping
