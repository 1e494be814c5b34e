// The two photon maps of a render: how many photons each gets, within which radius they are looked up, and what became
// of them. Every pass has photons of its own.
//
// A radius that is left open starts at a guess, what a small pilot run says of the photons' density, in proportion to
// n^(-1/6) of the photons that will have been emitted. After some passes their own evidence takes over
// (gather_bias.h): the radius that makes variance and squared bias together least, which falls at least as fast.
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
#include "renderer/photons/photon_map.h"
#include "renderer/photons/photons.h"
#include "renderer/planning/plan.h"
#include "renderer/scene/scene.h"
#include "scenes/description/integrator_description.h"

namespace photonproof::inline renderer_photon_mapping {

/// What a pass leaves to the next one: its photons are gone by then.
struct PhotonCounts {
  std::uint64_t emitted = 0;
  std::uint64_t stored = 0;
  std::uint64_t rays = 0;
  double around_one = 0;  ///< photons_around_one, of caustics whose radius is given, of passes until there are enough
};

/// How photons are emitted and looked up, whichever integrator asks.
struct PhotonSettings {
  PathLimits limits;
  std::int64_t global_photons = 0, caustic_photons = 0;  ///< over the whole render; 0: automatic
  double global_radius = 0, caustic_radius = 0;          ///< scene units; 0: automatic
  IndirectLight indirect = IndirectLight::map;
  double cache_error = 0;
  std::int64_t gather_rays = 0;
  /// As textbooks have it: every pass takes one sample a pixel and so many photons, each sample has its own gathers,
  /// and the radius shrinks by alpha, from the one that is given or the pilot's.
  struct Textbook {
    std::int64_t photons_a_pass;
    double alpha;
  };
  std::optional<Textbook> textbook{};
  /// A pass takes one of so many parts of the samples before it: few enough passes for samples of a pixel to share
  /// their gathers, enough for their spread to give a variance, and none that depends on where the render will end.
  /// Measured on course-1 at 600x600: a quarter takes 1.3 times as long to the same error.
  std::int64_t parts_of_samples = 2;

  /// What is automatic stays so where nothing else is asked for: numbers of photons, radii and views of a part of the
  /// light ask for maps, the view of a cache's records for a cache.
  PhotonSettings(const IntegratorDescription& description, const RenderJob& job);

  /// Whether light is looked for beyond the first diffuse surface, so that direct light and caustics there are needed
  /// even if a view shows only what comes of them.
  bool looks_further() const { return indirect != IndirectLight::map; }
};

/// One of the two maps, with what it takes to refill it every pass.
struct MapState {
  PhotonKind kind;
  Stream stream;
  const char* name;
  double photons_in_disc;  ///< what the first guess of a radius aims at, of 1e6 emitted
  bool wanted = false;
  bool aimed = false;         ///< emitted towards specular surfaces only
  double a_sample = 0;        ///< photons to emit for each camera sample of a pixel
  std::int64_t least = 1;     ///< photons of a pass
  bool fixed_radius = false;  ///< as the scene asks
  RadiusHistory radii{};
  std::vector<SheetTest> tests{};  ///< by surface
  PhotonCounts counts{};
  double pass_photons = 0;                          ///< emitted in this pass
  std::atomic<std::uint64_t> gathers{0}, found{0};  ///< photons, by all gathers of all passes
  PhotonMap map{};

  void count_found(const GatherPoints& points) {
    found += std::accumulate(points.found, points.found + points.count, std::uint64_t{0});
    gathers += points.count;
  }
  /// In the disc of a gather, over the whole render: each pass has a part of the photons.
  double in_disc(std::int64_t passes) const {
    return static_cast<double>(found) / static_cast<double>(std::max<std::uint64_t>(1, gathers)) *
           static_cast<double>(passes);
  }
};

/// What fills maps.
struct PhotonSource {
  const Scene& scene;
  const PhotonSettings& settings;
  const RenderJob& job;
  const Threads& threads;
};

struct PhotonMaps {
  MapState global{PhotonKind::global, global_photon_stream, "global", 700};
  MapState caustic{PhotonKind::caustic, caustic_photon_stream, "caustic", 8};

  /// Those that the plan wants, and how many photons they get.
  PhotonMaps(const RenderPlan& plan, const PhotonSource& source);
  /// Of those that are wanted: where the settings leave a radius open, a pilot run of photons says it.
  void choose_first_radii(const PhotonSource& source, RenderStats& stats);

  /// In the order in which their light is added.
  std::vector<MapState*> wanted();
  /// What decides the estimates besides the samples, for checkpoints.
  std::string totals() const;
  void store_counts(const Scene& scene, std::int64_t passes, RenderStats& stats) const;
  /// Sentences on radii and numbers of photons by which the image is worse than its error says.
  void say_what_is_lost(const Scene& scene, std::int64_t passes, RenderStats& stats) const;
};

/// The photons that a map stores in the pass that takes samples [first, last) of a pixel. Throws InputError when they
/// would not fit in memory.
Photons emit_photons(MapState& map, const PhotonSource& source, std::int64_t first, std::int64_t last,
                     RenderStats& stats);

/// Replaces the map's photons by those; returns how many were emitted.
std::uint64_t refill(MapState& map, const PhotonSource& source, std::int64_t first, std::int64_t last,
                     RenderStats& stats);

/// Of camera and light path together, for kernels.
int most_edges(const PhotonSettings& settings);

/// Finds the photons within the radius of every point, and the area they are to be divided by.
void radiance_estimate(const MapState& map, const PhotonSettings& settings, const GatherAreas& areas,
                       const GatherKernelEntry& kernels, GatherQueue& queue);

/// Of camera paths to where photons are looked up.
PathSettings camera_path_settings(const PhotonSettings& settings, const RenderPlan& plan);

/// Which paths the camera pass follows where photons are looked up at the first diffuse surface.
PathPolicy policy_of_maps(const Scene& scene, const PathSettings& settings);
/// Whether rough parts of other surfaces see caustics by photons, too.
bool splits_rough_parts(const Scene& scene, PathPolicy policy);
/// Whether paths that end where photons are looked up trace one more ray.
bool looks_at_environment(const Scene& scene, const PathSettings& settings);

/// What a radius shrinks to as there are so many times more photons.
double shrunk(double times);

/// Decides the map's radius for the next pass, that ends at sample `all_samples` of a pixel, from what the passes so
/// far showed.
void choose_next_radius(MapState& map, const PhotonSettings& settings, const GatherBias::Evidence& evidence,
                        const PassHalves& halves, double all_samples);

}  // namespace photonproof::inline renderer_photon_mapping
