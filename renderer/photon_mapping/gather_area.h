// Areas that photon gathers divide by, and the tests that match photons with points, for every surface of a scene.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "renderer/areas/curve_area.h"
#include "renderer/areas/ellipsoid_area.h"
#include "renderer/areas/mesh_area.h"
#include "renderer/kernels/tasks.h"
#include "renderer/photon_mapping/covered_area.h"
#include "renderer/scene/scene.h"

namespace photonproof::inline renderer_photon_mapping {

class GatherAreas {
 public:
  /// `scene` must outlive this.
  GatherAreas(const Scene& scene, const Threads& threads);

  /// The test for each surface in gathers of this radius; no stricter than the surface makes necessary.
  std::vector<SheetTest> tests(float radius) const;

  /// Divisor of a gather's flux: the area of the points whose photons it counts, times the probability that a photon is
  /// stored there. The area is 0 where rounding leaves none. The probability is that of choosing a Lambertian leaf of
  /// the surface's BSDF at `point`, or for a point of a rough part a leaf that can be rough. Photon and camera path
  /// both choose a leaf, so without the divisor the probability would enter twice.
  float divisor(const GatherPoint& point, float radius) const { return area(point, radius) * stored_share(point); }
  /// Fills the queue's column of areas, for the photons found within its radii. On large meshes neighbouring points
  /// share one measurement, in proportion to their squared radii.
  void fill(GatherQueue& points) const;

 private:
  float area(const GatherPoint& point, float radius) const;
  bool shares_area(std::uint32_t surface) const;
  /// The point as textures need it.
  struct TexturePoint {
    Vec2<float> uv;
    std::optional<PlacedPoint> placed;
  };
  TexturePoint texture_point(const GatherPoint& point) const;
  float stored_share(const GatherPoint& point) const;

  const Scene& scene_;
  std::map<const Mesh*, std::unique_ptr<const MeshArea>> meshes_;
  std::map<std::uint32_t, CurveArea> curves_;          ///< by surface
  std::map<std::uint32_t, EllipsoidArea> ellipsoids_;  ///< by surface
  struct MayMiss {
    bool lambertian = false, rough = false;
  };
  std::vector<MayMiss> may_miss_;         ///< by surface: whether some leaves store no photons
  std::vector<const MeshArea*> mesh_of_;  ///< by surface; null where it has no mesh or stores nothing
  CoveredAreas covered_;
};

}  // namespace photonproof::inline renderer_photon_mapping
