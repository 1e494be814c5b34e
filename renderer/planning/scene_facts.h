// Plain facts about a scene, computed once before it is built; parts that they rule out are neither built nor run.
#pragma once

#include <cstddef>

#include "renderer/scene/scene_parts.h"

namespace photonproof::inline renderer_planning {

struct SceneFacts {
  std::size_t primitives = 0;
  bool simple_primitives = true;  ///< parallelograms, triangles and spheres only
  std::size_t bsdf_kinds = 0;     ///< the number of kinds on surfaces
  bool all_plain = true;          ///< no textures, shading normals, tangents or nested BSDFs
  std::size_t media = 0;
  std::size_t lights = 0;
  bool many_lights = false;        ///< so many that a tree chooses them by position
  bool lights_can_be_hit = false;  ///< by a ray
  bool any_delta_light = false;    ///< one that rays never meet
  bool any_environment = false;

  double subtracted_by_filter = 0;  ///< factor of the filter's negative lobes (negative_lobes.h)

  std::size_t specular_surfaces = 0;     ///< Surfaces that are not Lambertian: caustics are possible.
  bool any_delta_bsdf = false;           ///< A mirror or smooth glass, or a BSDF of only those.
  bool any_delta_lobe = false;           ///< One of those, a clear coat, or a surface that light goes straight through.
  bool any_rough = false;                ///< A BSDF with a rough part for which photons can be gathered.
  bool any_sharp = false;                ///< A mirror, a sharp highlight or glass.
  bool any_diffuse = false;              ///< A surface that reflects diffusely with albedo above 0.
  bool diffuse_interreflection = false;  ///< Light can go from a diffuse surface to a diffuse surface.
};

/// Finds the facts. A feature counts as present where the geometry is not simple enough to decide, so that none that is
/// there is missed.
SceneFacts analyse(const SceneParts& scene);

}  // namespace photonproof::inline renderer_planning
