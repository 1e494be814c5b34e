// Automatic choice of the photon mapper's method for light between diffuse surfaces. The methods are its maps, path
// tracing beside the caustic map, and path tracing alone. A pilot of some thousand camera paths measures for each
// method the samples' variance V, relative to the image as in relmse, and the rays of a sample. Measured tables of the
// time of rays and gathers turn these into a time C. After S samples, that is after S C, the expected errors are:
//   path tracing   `relmse V/S`.
//   the maps       `relmse V/S + E(N)`, where E is the error of the best radius with N photons in all
//   (radius_trials.h).
// E is at least `3/2 i^2 / M` with `M = 700 (N / 1e6)^(2/3)`. Where no radii were tried it is just that; trials leave
// out the error of the caustic map. The term i^2 is the indirect part of the image's square, and M the number of
// photons in a disc. A gather's variance is 1/M, and its squared bias half of that at the best radius (gather_bias.h).
// So maps win early, path tracing late, and the requested error, samples or time decide.
//
// A wrong choice of paths costs a hundred times as much as one of maps, since rare bright samples may be missing from a
// pilot. So the choice leans to the maps:
//   - Path tracing alone finds caustics by rays that happen to meet lights. Its value of such a path is at most w B,
//     with the brightest radiance B and the part w that surfaces let through. So a caustic of light EX has
//     `E X^2 <= w B EX`. Caustic photons tell EX. V grows by that much for the light that the photons have and the
//     pilot's paths have not found.
//   - The variance that a method adds is relative to other pixels. Where a few pixels carry it, it has a standard error
//     more (path_pilot.h). The maps' own variance leaves out a part that one pixel may carry by chance.
// Where no ray meets lights, the caustic map stays.
//
// Pilots cost time, too. Camera paths come first. Where there is no caustic, and even maps without any error of their
// own would be later than path tracing, pilots included, no photon is traced.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "renderer/photon_mapping/path_pilot.h"
#include "renderer/photon_mapping/photon_maps.h"
#include "renderer/photon_mapping/radius_trials.h"

namespace photonproof::inline renderer_photon_mapping {

/// Camera paths of a pilot, for each method; it may trace a few more, and in small images fewer. A smaller pilot took
/// maps in furnaces at few samples, at up to 69 times the error of paths in the same time.
inline constexpr int pilot_camera_paths = 8192;

/// One method, as the pilot measured it.
struct WayOfLight {
  double variance = 0;     ///< of a camera sample: mean over channel values of variance / (mean^2 + 0.01)
  double nanoseconds = 0;  ///< Time of a camera sample, photons included.
};

struct IndirectPilot {
  WayOfLight maps, beside_caustics;
  std::optional<WayOfLight> paths_alone;  ///< Absent where the pilot cannot measure their error.
  bool caustics = false;                  ///< Whether there is a caustic map.
  double indirect_square = 0;             ///< The term i^2 of above.
  RadiusTrials trials{};                  ///< Radii of the global map; may be empty.
  double photons_a_sample = 0;            ///< The ratio N / S.
  double pixels = 1;
};

struct IndirectChoice {
  IndirectLight indirect = IndirectLight::map;
  bool caustic_map = true;  ///< whether to use the caustic map, if the scene has caustics
  std::string why;          ///< the reason, as a sentence
};

/// The method that first reaches the requested error, or the one with the least error after the requested samples or
/// time. Where paths are hardly better: the maps.
IndirectChoice choose_indirect(const IndirectPilot& pilot, const RenderBudget& budget, std::int64_t samples);

/// A clause about maps of a scene where emission_misses_planes is true (light_sampling/scene_lights.h).
inline constexpr const char* light_that_maps_miss =
    "photon maps miss what a plane without end throws back, from afar, of light from infinity";

/// The camera paths of the pilot, and the prices of the methods by them.
class IndirectPilots {
 public:
  /// Traces camera paths without photons. All arguments must outlive this.
  IndirectPilots(const PhotonSource& source, const PhotonMaps& maps, const RenderPlan& plan, const Tile& window,
                 RenderStats& stats);

  /// Path tracing, where there is no caustic and maps cannot be sooner. Empty where photons must decide.
  std::optional<IndirectChoice> choose_without_photons() const;
  /// Traces the other camera paths; the maps have their first radii. They cost less than trials of radii where meshes
  /// are large.
  void trace_beside_photons();
  /// Values by the maps' radii as they are now, and by their trials.
  IndirectPilot measured() const;
  /// Gathers of caustic photons on rough parts, and nanoseconds for them, a camera sample.
  double gathers_on_rough() const;
  double time_on_rough() const;

 private:
  double time_of_photons(const MapState& map, double rays_a_photon) const;
  double time_of_gathers(const MapState& map, const PointsBySurface& points, double each) const;
  WayOfLight way_of(const PilotImage& image, double nanoseconds) const;
  double maps_variance() const;
  double share_found() const;
  std::optional<WayOfLight> alone() const;

  const PhotonSource& source_;
  const PhotonMaps& maps_;
  const Tile window_;
  RenderStats& stats_;
  const PathSettings settings_;
  const double ray_;  ///< nanoseconds
  const bool caustics_;
  PathPilot tracer_;
  PilotImage direct_{}, beside_{};
  std::optional<PilotImage> alone_{};  ///< with caustics, where rays meet lights
  double brightest_ = 0;               ///< light, with caustics
  std::size_t caustic_photons_ = 0;    ///< of the pilot
  float rough_radius_ = 0;             ///< of the gathers on rough parts
};

}  // namespace photonproof::inline renderer_photon_mapping
