// The areas that photon look-ups divide by, and what they compare of photons and points, for every surface of a scene.
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "renderer/kernels/tasks.h"
#include "renderer/mesh_area.h"
#include "renderer/scene.h"

namespace photonproof {

class LookUpAreas {
 public:
  /// `scene` must outlive this.
  LookUpAreas(const Scene& scene, const Threads& threads);

  /// By surface, for look-ups of this radius: no more than the surface makes necessary.
  std::vector<SheetTest> tests(float radius) const;

  /// Of the points whose photons a look-up at `point` counts; 0 where rounding leaves none.
  float area(const GatherPoint& point, float radius) const;

 private:
  const Scene& scene_;
  std::map<const Mesh*, std::unique_ptr<const MeshArea>> meshes_;
  std::vector<const MeshArea*> mesh_of_;  ///< by surface; null where it is none, or nothing diffuse
};

}  // namespace photonproof
