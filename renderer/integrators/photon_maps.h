// The two photon maps of a render: how many photons each gets, within which radius they are looked up, and what became
// of them. Every pass has photons of its own.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

#include "renderer/passes/photon_tracing.h"
#include "renderer/passes/render_job.h"
#include "renderer/photons/photon_map.h"
#include "renderer/planning/plan.h"
#include "renderer/scene/scene.h"

namespace photonproof {

/// What a pass leaves to the next one: its photons are gone by then.
struct PhotonCounts {
  std::uint64_t emitted = 0;
  std::uint64_t stored = 0;
  std::uint64_t rays = 0;
  std::uint64_t look_ups = 0;
  std::uint64_t found = 0;  ///< by all of them

  /// In the disc of a look-up, over the whole render: each pass has a part of the photons.
  double in_disc(std::int64_t passes) const {
    return static_cast<double>(found) / static_cast<double>(std::max<std::uint64_t>(1, look_ups)) *
           static_cast<double>(passes);
  }
};

/// One of the two maps, with what it takes to refill it every pass.
struct MapState {
  PhotonKind kind;
  Stream stream;
  const char* name;
  double photons_in_disc;  ///< the automatic radius aims at this many over the whole render
  bool wanted = false;
  bool aimed = false;      ///< emitted towards specular surfaces only
  std::int64_t total = 0;  ///< photons to emit over the whole render
  float radius = 0;
  std::vector<SheetTest> tests{};  ///< by surface
  PhotonCounts counts{};
  std::atomic<std::uint64_t> found{0};  ///< in this pass
  PhotonMap map{};
};

/// What fills maps.
struct PhotonSource {
  const Scene& scene;
  const PhotonMapperDescription& settings;
  const RenderJob& job;
  const Threads& threads;
};

// Measured on cornell-spheres at 256^2, 1e6 photons, 32 samples a pixel: global discs of 50, 130, 350, 900 photons gave
// relmse .0029, .0021, .0017, .0016; caustic discs of 20 and 7 photons .0017 and .0014. Pixels average many look-ups,
// so smooth indirect light wants a wide disc and sharp caustics a small one.
struct PhotonMaps {
  MapState global{PhotonKind::global, global_photon_stream, "global", 350};
  MapState caustic{PhotonKind::caustic, caustic_photon_stream, "caustic", 8};

  /// Those that the plan wants, their totals and radii; where the settings leave a radius open, a pilot run of photons
  /// says it.
  PhotonMaps(const RenderPlan& plan, const PhotonSource& source, RenderStats& stats);

  /// In the order in which their light is added.
  std::vector<MapState*> wanted();
  /// What decides the estimates besides the samples, for checkpoints.
  std::string totals() const;
  void store_counts(double scale, std::int64_t passes, RenderStats& stats) const;
};

/// Replaces the map's photons by those of the pass that takes samples [first, last) of a pixel's `spp`. Throws
/// InputError when they would not fit in memory.
void refill(MapState& map, const PhotonSource& source, std::int64_t first, std::int64_t last, std::int64_t spp,
            RenderStats& stats);

}  // namespace photonproof
