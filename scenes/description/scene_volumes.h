// The volumes of a scene: those of its media and of its textures.
#pragma once

#include <variant>

#include "scenes/description/description.h"

namespace photonproof::inline scenes_description {

/// Calls `visit` with each GridVolumeDescription and ConstantVolumeDescription of a scene.
template <class Scene, class Visit>
void visit_volumes(Scene& scene, Visit&& visit) {
  const auto visit_value = [&](auto& value) {
    std::visit(
        [&](auto& v) {
          if constexpr (requires { v.to_world; }) visit(v);
        },
        value);
  };
  for (auto& medium : scene.media) visit_volume_values(medium, visit_value);
  for (auto& texture : scene.textures)
    if (auto* volume = std::get_if<VolumeTextureDescription>(&texture.pattern)) visit_value(volume->volume);
}

}  // namespace photonproof::inline scenes_description
