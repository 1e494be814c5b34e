// Data of a hit beyond its surface's one BSDF record and its geometric normal: texture values, shading normals,
// tangents, and the leaf BSDF below the wrapping ones. One scalar function computes it for every hit of a scene that
// needs any of it (SceneView::detailed); other scenes never call it.
#pragma once

#include <optional>

#include "renderer/bsdfs/bsdf.h"
#include "renderer/bsdfs/bsdf_table.h"
#include "renderer/bsdfs/scattering.h"
#include "renderer/photons/photon_columns.h"
#include "renderer/scene/scene_view.h"
#include "renderer/shapes/local_geometry.h"
#include "renderer/textures/texture.h"

namespace photonproof::inline renderer_scene {

/// 32-bit words only: kernels gather them.
struct SurfaceDetail {
  Vec3f normal;    ///< Shading normal, unit. On the back of a twosided BSDF it is turned towards the ray.
  Vec3f below[2];  ///< This and the next three are the members of MappedNormals, in world space.
  float shadow[2];
  std::uint32_t state;
  float chance;
  Vec3f tangent;             ///< Unit, perpendicular to `normal`, along dp/du; 0 where the leaf does not need it.
  std::uint32_t surface;     ///< Its number, and above it the bits of `state` that photons and gathers share.
  std::uint32_t bsdf, kind;  ///< The leaf's index among SceneView::bsdfs, and its kind in BsdfKinds.
  float record[BsdfKinds::stride];  ///< The leaf's record, with texture values in it.

  static constexpr std::uint32_t stride = 19 + BsdfKinds::stride;
};
static_assert(sizeof(SurfaceDetail) == SurfaceDetail::stride * sizeof(float));

/// Scattering at the hit. `normal`: the geometric one.
Scattering<float> scattering_at(const SceneView& scene, const SurfaceDetail& detail, const Vec3f& normal);

/// Tables that detail_at reads; owned by the scene.
struct DetailTables {
  const std::vector<Surface>& surfaces;
  const std::vector<AffineMap>& uv_frames;  ///< by Surface::uv_frame
  const Textures& textures;
  const BsdfTable& bsdfs;
  const std::vector<char>& plain;            ///< by surface: SceneParts::plain
  const std::uint32_t* triangles = nullptr;  ///< in a small scene: triangle index of each primitive in its mesh

  /// `primitive` as in SurfaceHit.
  LocalGeometry local(std::uint32_t surface, std::uint32_t primitive, const Vec3f& p, const Vec3f& normal) const;
  /// The point as textures need it.
  PlacedPoint placed_point(std::uint32_t surface, std::uint32_t primitive, const Vec3f& p) const;
};

/// The number of a surface without the bits that PhotonSurface has above it.
template <class U>
U surface_number(const U& tagged) {
  return tagged & PhotonSurface::number;
}

/// Computes the detail of a hit with `primitive`, `p` and the geometric `normal`. `direction` is that of the ray, which
/// comes from the camera or (importance) from a light. `u`, uniform in [0,1), chooses between blended BSDFs and between
/// a masked one and nothing. For a light path it also chooses between the sides that maps show.
void detail_at(const SceneView& scene, std::uint32_t surface, std::uint32_t primitive, const Vec3f& p,
               const Vec3f& normal, const Vec3f& direction, float u, TransportMode mode, SurfaceDetail& detail);

}  // namespace photonproof::inline renderer_scene
