// The compiled scene as the kernels see it: plain tables of 32-bit words, gathered by index. Scene owns them.
#pragma once

#include <cstdint>

#include "renderer/bsdfs/rough_part.h"
#include "renderer/lanes/sampler.h"
#include "renderer/rays/ray_scene.h"
#include "renderer/sensor/camera_view.h"

namespace photonproof::inline renderer_light_sampling {
class SceneLights;
struct ClearWays;
struct LightWords;
}  // namespace photonproof::inline renderer_light_sampling
namespace photonproof::inline renderer_shapes {
struct ProjectionTarget;
}

namespace photonproof::inline renderer_scene {

struct DetailTables;

struct SurfaceWords {
  std::uint32_t bsdf_kind, bsdf, light;
  std::uint32_t interior, exterior;  ///< media, no_index where there is none
  static constexpr std::uint32_t stride = 5;
};

struct SceneView : RayScene {
  bool one_light = false;         ///< There is no choice of a light.
  bool one_bsdf_kind = false;     ///< Lanes need no sorting.
  bool dark_shadow_rays = false;  ///< Shadow rays are traced even where they can bring no light.
  bool detailed = false;          ///< Hits go through detail_at (surface_detail.h).
  bool bends_normals = false;     ///< Shading normals may differ from geometric ones.
  bool maps_normals = false;      ///< Some of them by bump or normal maps.
  const DetailTables* detail = nullptr;
  const SurfaceWords* surfaces = nullptr;
  const float* bsdfs = nullptr;   ///< BsdfKinds::stride floats each
  const float* lights = nullptr;  ///< LightKinds::stride floats each
  const LightWords* light_words = nullptr;
  std::uint32_t light_count = 0;
  const SceneLights* general_lights = nullptr;  ///< all lights, for those that need tables
  bool lights_by_position = false;              ///< `general_lights` chooses them
  std::uint32_t environment = no_index;         ///< the light seen by rays that leave the scene
  const ClearWays* clear_ways = nullptr;
  const ProjectionTarget* projection_targets = nullptr;  ///< one for each specular surface
  std::uint32_t projection_target_count = 0;
  std::uint32_t bsdf_kinds = 0;  ///< bit k: a surface has a BSDF of kind k
  std::uint32_t light_kinds = 0;
  bool lights_can_be_hit = false;
  bool hides_lights = false;  ///< SceneChoices
  RoughLimit rough_limit{};
  bool guided_emission = false;  ///< `general_lights` decides where light paths start
  float coordinate_floor = 1;    ///< least magnitude of coordinates that ray offsets assume
  CameraView camera;
};

}  // namespace photonproof::inline renderer_scene
