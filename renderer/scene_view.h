// The compiled scene as the kernels see it: plain tables of 32-bit words, gathered by index. Scene owns them.
#pragma once

#include <cstdint>

#include "renderer/camera_view.h"
#include "renderer/ray.h"
#include "renderer/sampler.h"

namespace photonproof {

class SceneLights;
class Tracer;
struct DetailTables;

/// A flat primitive: the plane n.x = k (n unit, on the side that counts as front) and, for a point x of it,
/// u = edge_u . x + u0, v likewise, which run from 0 to 1 along the edges.
struct Plate {
  Vec3f normal;
  float k = 0;
  Vec3f edge_u;
  float u0 = 0;
  Vec3f edge_v;
  float v0 = 0;
  static constexpr std::uint32_t stride = 12;
};

struct Ball {
  Vec3f center;
  float radius = 0;
  float side = 1;  ///< 1: the normal points outward, -1: to the centre
  static constexpr std::uint32_t stride = 5;
};

/// Primitives in one list: parallelograms, then triangles, then spheres; `surface` maps them to surfaces.
struct SmallSceneView {
  const Plate* plates = nullptr;
  const Ball* balls = nullptr;
  const std::uint32_t* surface = nullptr;
  std::uint32_t parallelograms = 0, triangles = 0, spheres = 0;
};

struct SurfaceWords {
  std::uint32_t bsdf_kind, bsdf, light;
  std::uint32_t interior, exterior;  ///< media, no_index where there is none
  static constexpr std::uint32_t stride = 5;
};

struct LightWords {
  std::uint32_t kind;
  float probability;      ///< of being chosen
  float alias_threshold;  ///< alias method (Vose 1991): below it the light itself, above it `alias`
  std::uint32_t alias;
  std::uint32_t primitive;  ///< of a small scene, which its own shadow rays ignore
  static constexpr std::uint32_t stride = 5;
};

/// A ball that holds a specular surface.
struct AimTarget {
  Vec3f center;
  float radius = 0;
  static constexpr std::uint32_t stride = 4;
};

struct SceneView {
  bool one_light = false;         ///< none is chosen
  bool one_bsdf_kind = false;     ///< lanes need no sorting
  bool dark_shadow_rays = false;  ///< shadow rays are traced even where they can bring no light
  bool small = false;             ///< `primitives` holds everything, `tracer` is not needed
  bool detailed = false;          ///< hits go through detail_at (surface_detail.h)
  bool bends_normals = false;     ///< shading normals need not be geometric ones
  bool maps_normals = false;      ///< some of them by bump or normal maps
  SmallSceneView primitives;
  const DetailTables* detail = nullptr;
  const Tracer* tracer = nullptr;
  const SurfaceWords* surfaces = nullptr;
  const float* bsdfs = nullptr;   ///< BsdfKinds::stride floats each
  const float* lights = nullptr;  ///< LightKinds::stride floats each
  const LightWords* light_words = nullptr;
  std::uint32_t light_count = 0;
  const SceneLights* general_lights = nullptr;  ///< all lights, for those that need tables
  bool lights_by_position = false;              ///< they are chosen by `general_lights`
  std::uint32_t environment = no_index;         ///< the light that rays see which leave the scene
  const AimTarget* aim_targets = nullptr;       ///< one for each specular surface
  std::uint32_t aim_target_count = 0;
  std::uint32_t bsdf_kinds = 0;  ///< bit k: a surface has a BSDF of kind k
  std::uint32_t light_kinds = 0;
  bool lights_can_be_hit = false;
  bool guided_emission = false;  ///< `general_lights` says where light paths start
  float coordinate_floor = 1;    ///< least magnitude of coordinates that ray offsets reckon with
  CameraView camera;
};

}  // namespace photonproof
