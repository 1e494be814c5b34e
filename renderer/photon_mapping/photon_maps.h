// The two photon maps of a render: number of photons, gather radius and statistics. Every pass has photons of its own.
//
// A radius that is left open starts at a guess in proportion to n^(-1/6), from the photon density of a small pilot run.
// The number n is that of the photons to be emitted in all. After some passes their own evidence takes over
// (gather_bias.h): the radius that minimises variance plus squared bias. It falls at least as fast.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include "renderer/kernels/tasks.h"
#include "renderer/passes/render_job.h"
#include "renderer/photon_mapping/gather_area.h"
#include "renderer/photon_mapping/gather_bias.h"
#include "renderer/photon_mapping/photon_tracing.h"
#include "renderer/photon_mapping/radius_trials.h"
#include "renderer/photons/photon_map.h"
#include "renderer/photons/photons.h"
#include "renderer/planning/plan.h"
#include "renderer/scene/scene.h"
#include "scenes/description/integrator_description.h"

namespace photonproof::inline renderer_photon_mapping {

/// Statistics that a pass leaves to the next one, after its photons are freed.
struct PhotonCounts {
  std::uint64_t emitted = 0;
  std::uint64_t stored = 0;
  std::uint64_t rays = 0;
  double around_one = 0;  ///< sum of photons_around_one, until there are enough; for caustics of given radius
};

/// Parameters of photon emission and gathers, for every integrator.
struct PhotonSettings {
  PathLimits limits;
  std::int64_t global_photons = 0, caustic_photons = 0;  ///< Photons over the whole render; 0 is automatic.
  double global_radius = 0, caustic_radius = 0;          ///< Radius in scene units; 0 is automatic.
  IndirectLight indirect = IndirectLight::map;
  double cache_error = 0;
  std::int64_t gather_rays = 0;
  /// The textbook method. Every pass takes one sample a pixel and so many photons, and each sample has its own gathers.
  /// The radius shrinks by alpha from the given or the pilot's radius.
  struct Textbook {
    std::int64_t photons_a_pass;
    double alpha;
  };
  std::optional<Textbook> textbook{};
  /// A pass takes 1/parts_of_samples of the samples before it. Passes are few enough for samples of a pixel to share
  /// gathers, and enough for their spread to give a variance. They do not depend on where the render will end. Measured
  /// on course-1 at 600x600: with a quarter (4), the time to equal error is 1.3 times as long.
  std::int64_t parts_of_samples = 2;

  /// Whether pixels whose passes disagree get more samples. Where path tracing alone is chosen they do not: few passes
  /// with rare bright samples do not show which pixels need more. On `door-ajar`, 43 % more samples lowered the
  /// variance by 8 %.
  bool steers_samples = true;

  /// An automatic `indirect` stays so only where nothing else is requested. Numbers of photons, radii and views of a
  /// part of the light select maps; the view of a cache's records selects a cache.
  PhotonSettings(const IntegratorDescription& description, const RenderJob& job);

  /// Whether the method looks for light beyond the first diffuse surface. Direct light and caustics there are then
  /// needed even if a view shows only the light reflected from them.
  bool looks_further() const { return indirect != IndirectLight::map; }
};

/// Samples a pixel that the render takes; empty where time or an error decides.
std::optional<std::int64_t> known_samples(const RenderJob& job);

/// Light paths of the pilot that measures a map's first radius.
inline constexpr std::uint64_t pilot_photons = 20'000;

/// One of the two maps, with the state needed to refill it every pass.
struct MapState {
  PhotonKind kind;
  Stream stream;
  const char* name;
  double photons_in_disc;  ///< aim of the first guess of a radius, for 1e6 emitted photons
  bool wanted = false;
  bool aimed = false;         ///< photons are emitted towards specular surfaces only
  double a_sample = 0;        ///< photons to emit for each camera sample of a pixel
  std::int64_t least = 1;     ///< minimum of photons in a pass
  bool nearly_empty = false;  ///< the pilot stores no photon: a few are emitted, since some may still carry light
  bool fixed_radius = false;  ///< the scene gives the radius
  RadiusHistory radii{};
  std::vector<SheetTest> tests{};  ///< by surface
  PhotonCounts counts{};
  double pass_photons = 0;                          ///< Number emitted in this pass.
  Photons pilot{};                                  ///< of pilot_photons light paths; until radii are tried
  double rays_a_photon = 0;                         ///< of the pilot's light paths
  bool tried = false;                               ///< radii, once
  RadiusTrials trials{};                            ///< empty where the first guess stays
  std::atomic<std::uint64_t> gathers{0}, found{0};  ///< Number of gathers and of photons found, over all passes.
  PhotonMap map{};

  void count_found(const GatherPoints& points) {
    found += std::accumulate(points.found, points.found + points.count, std::uint64_t{0});
    gathers += points.count;
  }
  /// Photons in the disc of a gather over the whole render: each pass has a part of the photons.
  double in_disc(std::int64_t passes) const {
    return static_cast<double>(found) / static_cast<double>(std::max<std::uint64_t>(1, gathers)) *
           static_cast<double>(passes);
  }
};

/// Inputs for filling maps.
struct PhotonSource {
  const Scene& scene;
  const PhotonSettings& settings;
  const RenderJob& job;
  const Threads& threads;
};

struct PhotonMaps {
  MapState global{PhotonKind::global, global_photon_stream, "global", 700};
  MapState caustic{PhotonKind::caustic, caustic_photon_stream, "caustic", 8};

  /// Selects the maps that the plan wants, and their numbers of photons.
  PhotonMaps(const RenderPlan& plan, const PhotonSource& source);
  /// Sets the radii of the wanted maps, once. Where the settings leave a radius open, a pilot run of photons measures
  /// it.
  void choose_first_radii(const PhotonSource& source, RenderStats& stats);

  /// The wanted maps, in the order in which their light is added.
  std::vector<MapState*> wanted();
  /// Parameters besides the samples that determine the estimates, for checkpoints.
  std::string totals() const;
  void store_counts(const Scene& scene, std::int64_t passes, RenderStats& stats) const;
  /// Adds warnings on radii and numbers of photons that make the image worse than its error estimate.
  void say_what_is_lost(const Scene& scene, std::int64_t passes, RenderStats& stats) const;
};

/// The photons that a map stores in the pass of samples [first, last) of a pixel. Throws InputError when they would not
/// fit in memory.
Photons emit_photons(MapState& map, const PhotonSource& source, std::int64_t first, std::int64_t last,
                     RenderStats& stats);

/// Replaces the map's photons by those of that pass; returns how many were emitted.
std::uint64_t refill(MapState& map, const PhotonSource& source, std::int64_t first, std::int64_t last,
                     RenderStats& stats);

/// Maximum of edges of camera and light path together, for kernels.
int most_edges(const PhotonSettings& settings);

/// Finds the photons within the radius of every point, and the area to divide them by.
void radiance_estimate(const MapState& map, const PhotonSettings& settings, const GatherAreas& areas,
                       const GatherKernelEntry& kernels, GatherQueue& queue);

/// Settings of camera paths up to the points where photons are gathered.
PathSettings camera_path_settings(const PhotonSettings& settings, const RenderPlan& plan);

/// Policy of the camera pass where photons are gathered at the first diffuse surface.
PathPolicy policy_of_maps(const Scene& scene, const PathSettings& settings);
/// Whether caustic photons are also gathered at rough parts of other surfaces.
bool splits_rough_parts(const Scene& scene, PathPolicy policy);
/// Whether paths that end at a gather trace one more ray.
bool looks_at_environment(const Scene& scene, const PathSettings& settings);

/// Wider gathers would blur all shades of light.
double widest_useful(const Scene& scene);

/// Factor of a radius when there are `times` as many photons.
double shrunk(double times);

/// The radius for photons of so many light paths, as far as pilots know.
double guessed_radius(const MapState& map, double photons);

/// Decides the map's radius for the next pass, which ends at sample `all_samples` of a pixel, from the passes so far.
void choose_next_radius(MapState& map, const PhotonSettings& settings, const GatherBias::Evidence& evidence,
                        const PassHalves& halves, double all_samples);

}  // namespace photonproof::inline renderer_photon_mapping
