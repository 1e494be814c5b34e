// Area of flat surfaces covered by solids that stand on them or are sunk in them (footprint.h), for photon gathers.
// Solids are cubes and spheres that let no light through and have no light inside: no photon lands in their footprints.
#pragma once

#include <vector>

#include "renderer/areas/footprint.h"
#include "renderer/kernels/tasks.h"
#include "renderer/photons/surface_side.h"
#include "renderer/scene/scene_parts.h"
#include "renderer/scene/surface_detail.h"

namespace photonproof::inline renderer_photon_mapping {

class CoveredAreas {
 public:
  explicit CoveredAreas(const SceneParts& scene);

  /// The uncovered part of an area of the point's surface within the radius; 0 where rounding leaves next to nothing.
  float left_of(float area, const GatherPoint& point, float radius) const {
    const bool behind = (point.surface_side & SurfaceSide::from_behind) != 0;
    const std::vector<Footprint>& covered = (behind ? back_ : front_)[surface_number(point.surface)];
    return covered.empty() ? area : left_of(covered, area, point, radius);
  }

 private:
  static float left_of(const std::vector<Footprint>& covered, float area, const GatherPoint& point, float radius);

  std::vector<std::vector<Footprint>> front_, back_;  ///< by surface and its side; footprints do not overlap
};

}  // namespace photonproof::inline renderer_photon_mapping
