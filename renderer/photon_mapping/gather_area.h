// The areas that photon gathers divide by, and what they compare of photons and points, for every surface of a scene.
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "renderer/kernels/tasks.h"
#include "renderer/photon_mapping/covered_area.h"
#include "renderer/scene/scene.h"
#include "renderer/shapes/mesh_area.h"

namespace photonproof::inline renderer_photon_mapping {

class GatherAreas {
 public:
  /// `scene` must outlive this.
  GatherAreas(const Scene& scene, const Threads& threads);

  /// By surface, for gathers of this radius: no more than the surface makes necessary.
  std::vector<SheetTest> tests(float radius) const;

  /// What a gather's flux is divided by: the area of the points whose photons it counts, 0 where rounding leaves none,
  /// times how likely a photon that lands at `point` meets a Lambertian leaf of the surface's BSDF, or one that can be
  /// rough if the point is of a rough part. A photon is stored where it draws one, and the camera's path came here by
  /// drawing one too; the light that it reflects is all of it.
  float divisor(const GatherPoint& point, float radius) const { return area(point, radius) * stored_share(point); }
  /// Fills the queue's column, for what was found within its radii.
  void fill(GatherQueue& points) const;

 private:
  float area(const GatherPoint& point, float radius) const;
  Vec2<float> uv_at(const GatherPoint& point) const;
  float stored_share(const GatherPoint& point) const;

  const Scene& scene_;
  std::map<const Mesh*, std::unique_ptr<const MeshArea>> meshes_;
  struct MayMiss {
    bool lambertian = false, rough = false;
  };
  std::vector<MayMiss> may_miss_;         ///< by surface: whether it has leaves that are not
  std::vector<const MeshArea*> mesh_of_;  ///< by surface; null where it is none, or nothing is stored
  CoveredAreas covered_;
};

}  // namespace photonproof::inline renderer_photon_mapping
