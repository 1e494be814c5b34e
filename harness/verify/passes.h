// Splits a scene's light into passes: scenes with only a part of the light, which every engine can render. The first
// pass that an engine gets wrong shows its mistake.
#pragma once

#include <string>
#include <vector>

#include "scenes/description/description.h"

namespace photonproof::inline harness_verify {

struct ScenePass {
  std::string name;   ///< "direct", "mirror" ...
  std::string words;  ///< its contents
  SceneDescription scene;
};

/// From the simplest on; a pass is left out if the scene has nothing for it:
///   shapes    every surface emits light of its own and reflects none: camera, shapes, and which side is which
///   direct    lights on diffuse surfaces of a 32nd of their albedo; mirrors, glass and gloss are black
///   indirect  the same with all of the albedo
///   texture   direct light with its textures and maps, which are their mean before
///   gloss     direct light with plastic, lacquer and Phong
///   mirror    what mirrors show of surfaces that emit: no light, no caustic
///   glass     what is seen through glass of the same
///   caustic   all surfaces without textures; the light that mirrors and glass throw on diffuse ones is new
///   medium    the same with the media
/// No pass contains what only the whole scene has.
std::vector<ScenePass> passes_of(const SceneDescription& scene);

}  // namespace photonproof::inline harness_verify
