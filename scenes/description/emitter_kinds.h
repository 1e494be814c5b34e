// What kinds of emitters have in common.
#pragma once

#include <variant>

#include "scenes/description/light_description.h"

namespace photonproof::inline scenes_description {

inline EmitterTraits traits_of(const EmitterDescription& emitter) {
  return std::visit([]<class Light>(const Light&) { return Light::traits; }, emitter.light);
}

/// It has one point or one direction: no ray meets it.
inline bool is_without_size(const EmitterDescription& emitter) { return traits_of(emitter).without_size; }

/// Its light comes from all around, and is given by direction.
inline bool surrounds(const EmitterDescription& emitter) { return traits_of(emitter).surrounds; }

/// Its light comes from beyond the scene.
inline bool is_infinitely_far(const EmitterDescription& emitter) { return traits_of(emitter).infinitely_far; }

}  // namespace photonproof::inline scenes_description
