// What kinds of emitters have in common.
#pragma once

#include <variant>

#include "scenes/description/light_description.h"

namespace photonproof::inline scenes_description {

/// It has one point or one direction: no ray meets it.
inline bool is_without_size(const EmitterDescription& emitter) {
  return std::holds_alternative<PointLightDescription>(emitter.light) ||
         std::holds_alternative<SpotLightDescription>(emitter.light) ||
         std::holds_alternative<DirectionalLightDescription>(emitter.light) ||
         std::holds_alternative<IesLightDescription>(emitter.light);
}

/// Its light comes from all around, and is given by direction.
inline bool surrounds(const EmitterDescription& emitter) {
  return std::holds_alternative<ConstantLightDescription>(emitter.light) ||
         std::holds_alternative<EnvmapDescription>(emitter.light);
}

/// Its light comes from beyond the scene.
inline bool is_infinitely_far(const EmitterDescription& emitter) {
  return surrounds(emitter) || std::holds_alternative<SunSkyDescription>(emitter.light) ||
         std::holds_alternative<DirectionalLightDescription>(emitter.light);
}

}  // namespace photonproof::inline scenes_description
