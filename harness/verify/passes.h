// A scene's light in passes: scenes in which only a part of it is left, which every engine can render without knowing
// why. Where one is wrong, the first pass in which it is says what is.
#pragma once

#include <string>
#include <vector>

#include "scenes/description/description.h"

namespace photonproof::inline harness_verify {

struct ScenePass {
  std::string name;   ///< "direct", "mirror" ...
  std::string words;  ///< what it is made of
  SceneDescription scene;
};

/// From the simplest on; only those that the scene has something for:
///   shapes    every surface emits light of its own and reflects none: camera, shapes, and which side is which
///   direct    lights on diffuse surfaces of a 32nd of their albedo; mirrors, glass and gloss are black
///   indirect  the same with all of the albedo
///   texture   direct light with its textures and maps, which are their mean before
///   gloss     direct light with plastic, lacquer and Phong
///   mirror    what mirrors show of surfaces that emit: no light, no caustic
///   glass     what is seen through glass of the same
///   caustic   all surfaces but for textures, whose light by mirrors and glass on diffuse ones is new
///   medium    the same with the media
/// What only the whole scene has is in none of them.
std::vector<ScenePass> passes_of(const SceneDescription& scene);

}  // namespace photonproof::inline harness_verify
