// The camera's half of a pass of the photon mapper: paths to their first diffuse surfaces, and the light that the maps'
// photons bring to the paths' ends.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/irradiance/irradiance_cache.h"
#include "renderer/passes/aov.h"
#include "renderer/passes/render_loop.h"
#include "renderer/passes/scratch_pool.h"
#include "renderer/photon_mapping/adaptive_sample_map.h"
#include "renderer/photon_mapping/gather_area.h"
#include "renderer/photon_mapping/gather_bias.h"
#include "renderer/photon_mapping/photon_maps.h"
#include "renderer/photon_mapping/shared_gathers.h"
#include "renderer/planning/plan.h"

namespace photonproof::inline renderer_photon_mapping {

class CameraPass {
 public:
  /// Pass null `areas` without maps. All arguments must outlive this object.
  CameraPass(const Scene& scene, const PhotonSettings& settings, const RenderPlan& plan, const RenderJob& job,
             std::vector<MapState*> maps_shown, const GatherAreas* areas, GatherBias& bias, AdaptiveSampleMap& effort);
  /// From now on takes the global map's light from this cache.
  void use(const IrradianceCache& cache) { cache_ = &cache; }

  /// Adds the tile's estimate of pass number `pass` to the image, to the bias and to the effort. If the view is a
  /// number, also adds that number to `numbers`.
  void render(const Tile& tile, std::int64_t pass, RenderLoop& loop, Film& image, Film* numbers);

 private:
  struct TilePaths;
  void trace(const CameraTask& camera, TilePaths& paths, RenderLoop& loop);
  void follow(TilePaths& paths, RenderLoop& loop);
  void trace_extra(TilePaths& paths, RenderLoop& loop);
  void leave_points(PathTask& task, TilePaths& paths) const;
  void gather_on_rough(RoughGathers& rough, TilePaths& paths) const;
  void add_photons(TilePaths& paths);
  void add_photons_on_rough(TilePaths& paths);
  void add_numbers(TilePaths& paths, double seconds, Film& numbers) const;
  std::vector<Rgb> radii_in_pixels(TilePaths& paths) const;
  void add_photons_of(MapState& map, const std::vector<PixelPoint>& points, const BlockGrid& blocks, std::uint32_t key,
                      TilePaths& paths);
  double pixels_a_radius(const MapState& map) const {
    return static_cast<double>(map.radii.radius) / static_cast<double>(footprint_);
  }
  /// Whether radii differ from place to place.
  bool narrows(const MapState& map) const { return shares_ && !map.fixed_radius; }
  float radius_at(const MapState& map, std::size_t pixel, const TilePaths& paths) const;
  std::vector<float> radii_of(const MapState& map, const std::vector<PixelPoint>& points, const TilePaths& paths) const;
  void gather_in(const MapState& map, GatherQueue& queue) const;
  void look_twice(const MapState& map, const std::vector<PixelPoint>& points, SharedGathers& shared, TilePaths& paths);
  void add_lost(const MapState& map, std::uint32_t pixel, const Rgb& lost, const TilePaths& paths);

  const Scene& scene_;
  const RenderJob& job_;
  const AovRow& view_;
  const bool shares_;  ///< Whether samples share gathers.
  const IrradianceCache* cache_ = nullptr;
  const std::vector<MapState*> maps_;
  MapState* const caustic_;         ///< Null without a caustic map.
  const MapState* const gathered_;  ///< Global map for gathers one bounce further (final_gather.h); null without.
  const bool traces_paths_;         ///< Paths are traced beyond the first diffuse surface, in place of a global map.
  const bool goes_on_;              ///< Light is sought beyond the first diffuse surface, by gathers or by paths.
  const GatherAreas* const areas_;
  GatherBias& bias_;
  AdaptiveSampleMap& effort_;
  const PhotonSettings& settings_;
  const PathSettings path_settings_;
  const NegativeLobes lobes_;
  const float footprint_;  ///< footprint of a pixel, at the median of the visible points
  ScratchPool scratch_;
};

}  // namespace photonproof::inline renderer_photon_mapping
