// Plain facts about a scene, computed once before rendering; passes the facts rule out are not run.
#pragma once

#include "renderer/scene/scene.h"

namespace photonproof {

struct SceneFacts {
  bool any_specular = false;             ///< a surface that is not Lambertian: caustics are possible
  bool any_diffuse = false;              ///< a surface that reflects diffusely with albedo above 0
  bool diffuse_interreflection = false;  ///< light can go from a diffuse surface to a diffuse surface
  bool any_light_surface = false;        ///< a ray can hit a light
};

/// Never says that something is absent when it is there: where the geometry is not simple enough to decide, it is
/// present.
SceneFacts analyse(const Scene& scene);

}  // namespace photonproof
