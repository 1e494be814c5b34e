// Plain facts about a scene, computed once before it is built; what they rule out is neither built nor run.
#pragma once

#include <cstddef>

#include "renderer/scene/scene_parts.h"

namespace photonproof::inline renderer_planning {

struct SceneFacts {
  std::size_t primitives = 0;
  bool simple_primitives = true;  ///< parallelograms, triangles and spheres only
  std::size_t bsdf_kinds = 0;     ///< how many there are on surfaces
  bool all_plain = true;          ///< no textures, shading normals, tangents or nested BSDFs
  std::size_t media = 0;
  std::size_t lights = 0;
  bool many_lights = false;        ///< so many that there is a tree to choose them by position
  bool lights_can_be_hit = false;  ///< by a ray
  bool any_delta_light = false;    ///< one that no ray can meet
  bool any_environment = false;

  std::size_t specular_surfaces = 0;     ///< surfaces that are not Lambertian: caustics are possible
  bool any_delta_bsdf = false;           ///< a mirror or smooth glass, or nothing but those
  bool any_delta_lobe = false;           ///< one of those, a clear coat, or a surface that light goes straight through
  bool any_rough = false;                ///< a BSDF with a rough part for which photons can be looked up
  bool any_sharp = false;                ///< a mirror, a sharp highlight or glass
  bool any_diffuse = false;              ///< a surface that reflects diffusely with albedo above 0
  bool diffuse_interreflection = false;  ///< light can go from a diffuse surface to a diffuse surface
};

/// Never says that something is absent when it is there: where the geometry is not simple enough to decide, it is
/// present.
SceneFacts analyse(const SceneParts& scene);

}  // namespace photonproof::inline renderer_planning
