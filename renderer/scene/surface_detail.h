// What a hit needs beyond its surface's one BSDF record and its geometric normal: texture values, shading normals,
// tangents, and which leaf the wrapping BSDFs come down to. One scalar function, called for every hit of a scene that
// has any of it (SceneView::detailed); other scenes never come here.
#pragma once

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
  Vec3f normal;    ///< of the shading frame: unit; on the far side of a twosided BSDF turned towards the ray
  Vec3f below[2];  ///< this and the next four in world space what MappedNormals has in the frame
  float shadow[2];
  std::uint32_t state;
  float chance;
  Vec3f tangent;             ///< unit, perpendicular to `normal`, along dp/du; 0 where the leaf does not ask for it
  std::uint32_t surface;     ///< its number, and above it the bits of `state` that photons and gathers share
  std::uint32_t bsdf, kind;  ///< bsdf: the leaf, among SceneView::bsdfs; kind: of BsdfKinds
  float record[BsdfKinds::stride];  ///< of the leaf, texture values in it

  static constexpr std::uint32_t stride = 19 + BsdfKinds::stride;
};
static_assert(sizeof(SurfaceDetail) == SurfaceDetail::stride * sizeof(float));

/// How light scatters there. `normal`: the geometric one.
Scattering<float> scattering_at(const SceneView& scene, const SurfaceDetail& detail, const Vec3f& normal);

/// What detail_at looks up; owned by the scene.
struct DetailTables {
  const std::vector<Surface>& surfaces;
  const std::vector<AffineMap>& uv_frames;  ///< by Surface::uv_frame
  const Textures& textures;
  const BsdfTable& bsdfs;
  const std::vector<char>& plain;            ///< of a surface: SceneParts::plain
  const std::uint32_t* triangles = nullptr;  ///< of a small scene: which of its mesh a primitive is

  /// `primitive` as SurfaceHit has it.
  LocalGeometry local(std::uint32_t surface, std::uint32_t primitive, const Vec3f& p, const Vec3f& normal) const;
};

/// The number of a surface without what PhotonSurface has above it.
template <class U>
U surface_number(const U& tagged) {
  return tagged & PhotonSurface::number;
}

/// `primitive`, `p`, `normal` (geometric) of the hit; `direction` of the ray, which comes from the camera or
/// (importance) from a light; `u`, uniform in [0,1), chooses between blended BSDFs and between a masked one and
/// nothing, and for a light path between what maps show to the one side and to the other.
void detail_at(const SceneView& scene, std::uint32_t surface, std::uint32_t primitive, const Vec3f& p,
               const Vec3f& normal, const Vec3f& direction, float u, TransportMode mode, SurfaceDetail& detail);

}  // namespace photonproof::inline renderer_scene
