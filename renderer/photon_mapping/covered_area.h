// Area of flat surfaces covered by solids that stand on them or are sunk in them (footprint.h), for photon gathers.
// Solids are cubes and spheres that let no light through and have no light inside: no photon lands in their footprints.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "renderer/areas/covered_part.h"
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
    if (part_of_.empty()) return area;
    const bool behind = (point.surface_side & SurfaceSide::from_behind) != 0;
    const std::uint32_t part = part_of_[surface_number(point.surface)][behind ? 1 : 0];
    return part == no_index ? area : left_of(parts_[part], area, point, radius);
  }

 private:
  static float left_of(const CoveredPart& part, float area, const GatherPoint& point, float radius);

  std::vector<std::array<std::uint32_t, 2>>
      part_of_;  ///< by surface, of its front and back; empty where none is covered
  std::vector<CoveredPart> parts_;
};

}  // namespace photonproof::inline renderer_photon_mapping
