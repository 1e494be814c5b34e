// The time that gathers on meshes spend on the areas that they divide by (mesh_area.h). It follows from numbers of
// triangles alone, since a choice by it must not depend on the machine.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/scene/scene.h"

namespace photonproof::inline renderer_planning {

class AreaPrices {
 public:
  /// For gathers within `radius`. Meshes are taken to have triangles of one size.
  AreaPrices(const Scene& scene, float radius);

  /// Nanoseconds of a gather on the surface of that number, 0 where it is no mesh.
  double of(std::uint32_t surface) const { return price_.empty() ? 0 : price_[surface]; }
  /// Nanoseconds of numbers of gathers, by surface.
  double time_of(const std::vector<double>& gathers) const;

 private:
  std::vector<double> price_;  ///< by surface; empty without meshes
};

}  // namespace photonproof::inline renderer_planning
